// Keeps a view open: waits until the server is healthy, opens the stream, and does it again, less and less often, when it breaks.
import { type MessageInitShape } from "@bufbuild/protobuf";
import { Code, ConnectError } from "@connectrpc/connect";
import { HealthCheckResponse_ServingStatus as ServingStatus } from "../generated/grpc/health/v1/health_pb";
import { type Frame, type FrameRequestSchema } from "../generated/radiata/v1/frame_pb";
import { type Services } from "../service";
import { Backoff } from "./backoff";
import { isViewGone, passes, sentence } from "./failures";
import { type Change, Updates } from "./updates";

export type ConnectionState = "connecting" | "connected" | "reconnecting" | "refused";

export interface ConnectionOptions {
  /** Runs before each attempt to open the view, after the health check. */
  prepare: (signal: AbortSignal) => Promise<void>;
  /** What the view shows when it is opened. */
  request: () => MessageInitShape<typeof FrameRequestSchema>;
  /** A frame of the present view; `acknowledge` must be called once it is on the screen or dropped. */
  frame: (frame: Frame, acknowledge: () => void) => void;
  state: (state: ConnectionState, reason: string) => void;
  /** An update was refused; the view stays as it was. */
  refused: (reason: string) => void;
  /** A change gets the number that the frames which answer it carry. */
  numbered: (cameraSequence: bigint, change: Change) => void;
}

const kProbeEveryMs = 10_000;
const kCallTimeoutMs = 5_000;
/** A view that a server draws for the first time may have to wait for its dataset. */
const kOpenTimeoutMs = 60_000;

export class Connection {
  private updates: Updates | null = null;
  /** Of the open view; empty: none. */
  viewId = "";
  /** What changed after the request was made and before the view was open. */
  private missed: Change | null = null;
  private waitsForChange = false;
  private attempt = new AbortController();
  private wake: () => void = () => {};
  private closed = false;
  private readonly backoff = new Backoff();

  constructor(
    private readonly services: Services,
    private readonly options: ConnectionOptions,
  ) {
    // A network that came back, or a laptop that woke up, need not wait for the rest of the pause.
    globalThis.addEventListener?.("online", () => this.wake());
  }

  /** Sends a change of the view; while there is none it is kept until one is open, and ends the wait after a refusal. */
  change(change: Change): void {
    if (this.updates) {
      this.updates.push(change);
      return;
    }
    this.missed = { ...this.missed, ...change };
    if (this.waitsForChange) this.wake();
  }

  close(): void {
    this.closed = true;
    this.attempt.abort();
    this.wake();
  }

  /** Runs until `close`. */
  async run(): Promise<void> {
    this.options.state("connecting", "");
    while (!this.closed) {
      try {
        this.attempt = new AbortController();
        await this.serving();
        await this.options.prepare(this.attempt.signal);
        await this.view();
        throw new ConnectError("The server closed the view.", Code.Unavailable);
      } catch (error) {
        if (this.closed) return;
        const again = passes(error);
        this.options.state(again ? "reconnecting" : "refused", sentence(error));
        // After a refusal the same request would be refused again: wait for a change, or for a restarted server.
        this.waitsForChange = !again;
        await this.pause(again ? this.backoff.next() : 30_000);
        this.waitsForChange = false;
      }
    }
  }

  private async serving(): Promise<void> {
    const answer = await this.services.health.check({}, { signal: this.attempt.signal, timeoutMs: kCallTimeoutMs });
    if (answer.status !== ServingStatus.SERVING) {
      throw new ConnectError("The server is not ready yet.", Code.Unavailable);
    }
  }

  private async view(): Promise<void> {
    const attempt = this.attempt;
    const signal = attempt.signal;
    let timer = setTimeout(() => attempt.abort(new ConnectError("The server did not open the view.", Code.Unavailable)), kOpenTimeoutMs);
    let updates: Updates | null = null;
    try {
      const frame = this.options.request();
      this.missed = null;
      for await (const message of this.services.view.open({ frame }, { signal })) {
        if (updates === null && message.viewId !== "") {
          clearTimeout(timer);
          updates = this.begin(message.viewId, attempt);
          timer = setInterval(() => updates?.probe(), kProbeEveryMs);
        }
        const shown = message.frame;
        if (shown) {
          const current = updates;
          this.options.frame(shown, () => current?.acknowledge(shown.sequence));
        }
      }
    } catch (error) {
      throw signal.aborted && signal.reason instanceof ConnectError ? signal.reason : error;
    } finally {
      clearTimeout(timer);
      clearInterval(timer);
      updates?.stop();
      this.updates = null;
      this.viewId = "";
    }
  }

  private begin(viewId: string, attempt: AbortController): Updates {
    this.backoff.reset();
    this.viewId = viewId;
    this.updates = new Updates(viewId, 0n, {
      send: async (message) => {
        await this.services.view.update(message, { signal: attempt.signal, timeoutMs: kCallTimeoutMs });
      },
      numbered: this.options.numbered,
      failed: (error) => {
        if (attempt.signal.aborted) return;
        if (isViewGone(error) || passes(error)) attempt.abort(ConnectError.from(error));
        else this.options.refused(sentence(error));
      },
    });
    this.options.state("connected", "");
    if (this.missed) this.updates.push(this.missed);
    this.missed = null;
    return this.updates;
  }

  private async pause(ms: number): Promise<void> {
    await new Promise<void>((resolve) => {
      const timer = setTimeout(resolve, ms);
      this.wake = () => {
        clearTimeout(timer);
        resolve();
      };
    });
    this.wake = () => {};
  }
}
