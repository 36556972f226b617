// The status line: what the picture on the screen is, how long it took, how old it was, and how the connection is.
import { type Frame, FrameState } from "../generated/radiata/v1/frame_pb";
import { type ConnectionState } from "../view/connection";

export const kStateNames: Record<FrameState, string> = {
  [FrameState.UNSPECIFIED]: "no picture",
  [FrameState.INTERACTIVE]: "interactive",
  [FrameState.REFINING]: "refining",
  [FrameState.CONVERGED]: "converged",
};

export const kConnectionNames: Record<ConnectionState, string> = {
  connecting: "connecting",
  connected: "connected",
  reconnecting: "reconnecting",
  refused: "refused",
};

export const milliseconds = (ms: number | null): string =>
  ms === null || !Number.isFinite(ms) ? "–" : ms < 9.95 ? `${ms.toFixed(1)} ms` : `${Math.round(ms)} ms`;

export const frameTime = (ms: number | null): string =>
  ms === null ? "–" : `${milliseconds(ms)} (${(1000 / ms).toFixed(ms > 100 ? 1 : 0)} fps)`;

export interface StatusElements {
  readonly frame: HTMLElement;
  readonly render: HTMLElement;
  readonly age: HTMLElement;
  readonly state: HTMLElement;
  readonly connection: HTMLElement;
  readonly message: HTMLElement;
}

export class StatusLine {
  constructor(private readonly elements: StatusElements) {}

  frame(frame: Frame, frameMs: number | null, ageMs: number | null): void {
    this.elements.frame.textContent = frameTime(frameMs);
    this.elements.render.textContent = milliseconds(frame.timing?.renderMs ?? null);
    this.elements.age.textContent = milliseconds(ageMs);
    const samples = frame.samples > 1 ? `, ${frame.samples} samples` : "";
    this.elements.state.textContent = kStateNames[frame.state] + samples;
    this.elements.state.dataset.value = kStateNames[frame.state];
  }

  connection(state: ConnectionState, reason: string): void {
    this.elements.connection.textContent = kConnectionNames[state];
    this.elements.connection.dataset.value = state;
    this.message(state === "connected" ? "" : reason);
  }

  message(sentence: string): void {
    this.elements.message.textContent = sentence;
    this.elements.message.hidden = sentence === "";
  }
}
