// The canvas that fills the window, and its size in device pixels.

export interface PixelSize {
  readonly width: number;
  readonly height: number;
}

export interface PixelLimits {
  readonly widthMax: number;
  readonly heightMax: number;
  readonly pixelsMax: number;
}

/** The largest size of the same shape that the limits allow; at least 1 by 1. */
export function fit(size: PixelSize, limits: PixelLimits): PixelSize {
  const factor = Math.min(
    1,
    limits.widthMax / size.width,
    limits.heightMax / size.height,
    Math.sqrt(limits.pixelsMax / (size.width * size.height)),
  );
  return { width: Math.max(1, Math.floor(size.width * factor)), height: Math.max(1, Math.floor(size.height * factor)) };
}

export class Screen {
  private readonly context: CanvasRenderingContext2D;
  /** Of the element on the screen, device pixels. */
  size: PixelSize;

  constructor(
    readonly canvas: HTMLCanvasElement,
    resized: () => void,
  ) {
    const context = canvas.getContext("2d", { alpha: false });
    if (!context) throw new Error("This browser gives the page no canvas to draw on.");
    this.context = context;
    this.size = this.measure();
    new ResizeObserver((entries) => {
      const box = entries[0]?.devicePixelContentBoxSize?.[0];
      const size = box ? { width: box.inlineSize, height: box.blockSize } : this.measure();
      if (size.width === 0 || size.height === 0) return;
      if (size.width === this.size.width && size.height === this.size.height) return;
      this.size = size;
      resized();
    }).observe(canvas);
  }

  /** Draws pixel for pixel; the element scales the picture while it has another size than the window. */
  show(bitmap: ImageBitmap): void {
    if (this.canvas.width !== bitmap.width || this.canvas.height !== bitmap.height) {
      this.canvas.width = bitmap.width;
      this.canvas.height = bitmap.height;
    }
    this.context.drawImage(bitmap, 0, 0);
    bitmap.close();
  }

  private measure(): PixelSize {
    const ratio = globalThis.devicePixelRatio || 1;
    return {
      width: Math.max(1, Math.round(this.canvas.clientWidth * ratio)),
      height: Math.max(1, Math.round(this.canvas.clientHeight * ratio)),
    };
  }
}
