// Turns frames into bitmaps, one at a time; a frame that a newer one overtakes while it waits is never decoded.
import { type Frame, ImageFormat } from "../generated/radiata/v1/frame_pb";

export interface Decoded<Bitmap> {
  readonly frame: Frame;
  readonly bitmap: Bitmap;
}

interface Waiting {
  readonly frame: Frame;
  readonly done: () => void;
}

export interface DecoderOptions<Bitmap> {
  decode: (frame: Frame) => Promise<Bitmap>;
  show: (decoded: Decoded<Bitmap>) => void;
  failed: (frame: Frame, error: unknown) => void;
}

export class Decoder<Bitmap> {
  private waiting: Waiting | null = null;
  private busy = false;
  private epoch = 0;
  dropped = 0;

  constructor(private readonly options: DecoderOptions<Bitmap>) {}

  /** \param done  called when the frame was shown or dropped */
  push(frame: Frame, done: () => void): void {
    if (this.waiting) {
      this.dropped += 1;
      this.waiting.done();
    }
    this.waiting = { frame, done };
    if (!this.busy) void this.drain();
  }

  /** Forgets what waits or is being decoded: frames of a view that has ended. */
  reset(): void {
    this.epoch += 1;
    this.waiting = null;
  }

  private async drain(): Promise<void> {
    this.busy = true;
    while (this.waiting) {
      const { frame, done } = this.waiting;
      const epoch = this.epoch;
      this.waiting = null;
      try {
        const bitmap = await this.options.decode(frame);
        if (epoch === this.epoch) this.options.show({ frame, bitmap });
        else this.dropped += 1;
      } catch (error) {
        this.options.failed(frame, error);
      }
      done();
    }
    this.busy = false;
  }
}

/** The browser's own decoder; pixels come out as they were encoded. */
export function decodeBitmap(frame: Frame): Promise<ImageBitmap> {
  const type = frame.format === ImageFormat.JPEG ? "image/jpeg" : "image/png";
  const bytes = frame.image as Uint8Array<ArrayBuffer>;
  return createImageBitmap(new Blob([bytes], { type }), { colorSpaceConversion: "none", premultiplyAlpha: "none" });
}
