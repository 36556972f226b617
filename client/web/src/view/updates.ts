// Sends the changes of a view, one call under way at a time: what comes meanwhile is merged, so that the server always gets the
// newest camera and never a queue of old ones. Every call acknowledges the newest frame shown; without a change that is all it does.
import { type MessageInitShape } from "@bufbuild/protobuf";
import { type UpdateRequestSchema } from "../generated/radiata/v1/view_pb";

export type UpdateMessage = MessageInitShape<typeof UpdateRequestSchema>;

/** The parts of a view that can change. */
export type Change = Pick<UpdateMessage, "camera" | "scene" | "quality" | "width" | "height" | "clientTimeMs">;

export interface UpdatesOptions {
  send: (message: UpdateMessage) => Promise<void>;
  /** Called once for a failed call; later changes are still sent. */
  failed: (error: unknown) => void;
  /** A change gets its number, just before it is sent. */
  numbered?: (cameraSequence: bigint, change: Change) => void;
}

export class Updates {
  private change: Change | null = null;
  private acknowledged = 0n;
  private sentAcknowledged = 0n;
  private underWay = false;
  private stopped = false;

  /** \param cameraSequence  number of the latest change already known to the server */
  constructor(
    private readonly viewId: string,
    public cameraSequence: bigint,
    private readonly options: UpdatesOptions,
  ) {}

  push(change: Change): void {
    this.change = { ...this.change, ...change };
    this.flush();
  }

  acknowledge(sequence: bigint): void {
    if (sequence > this.acknowledged) this.acknowledged = sequence;
    this.flush();
  }

  /** Sends an acknowledgement even if nothing is new: tells whether server and view are still there. */
  probe(): void {
    if (!this.underWay) void this.call();
  }

  stop(): void {
    this.stopped = true;
  }

  private flush(): void {
    if (this.underWay || this.stopped) return;
    if (this.change !== null || this.acknowledged > this.sentAcknowledged) void this.call();
  }

  private async call(): Promise<void> {
    this.underWay = true;
    const change = this.change;
    this.change = null;
    if (change !== null) {
      this.cameraSequence += 1n;
      this.options.numbered?.(this.cameraSequence, change);
    }
    const acknowledged = this.acknowledged;
    try {
      await this.options.send({
        viewId: this.viewId,
        acknowledgedSequence: acknowledged,
        cameraSequence: this.cameraSequence,
        ...change,
      });
      this.sentAcknowledged = acknowledged;
    } catch (error) {
      // Taken as sent: a failed call must not be repeated for ever; the failure handler decides whether the view is reopened.
      this.sentAcknowledged = acknowledged;
      if (!this.stopped) this.options.failed(error);
    }
    this.underWay = false;
    this.flush();
  }
}
