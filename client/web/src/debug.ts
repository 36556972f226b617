// A read-only look into the page for its tests and for curious people: `window.radiata`. Nothing of the page depends on it.
import { toJson } from "@bufbuild/protobuf";
import { type Camera, toMessage } from "./camera/camera";
import { CameraSchema } from "./generated/radiata/v1/camera_pb";
import { type Frame, FrameRequestSchema } from "./generated/radiata/v1/frame_pb";
import { kStateNames } from "./status/line";

export interface ShownFrame {
  /** Frame.sequence; starts at 1 again after a reconnection. */
  readonly sequence: number;
  readonly cameraSequence: number;
  readonly state: string;
  readonly format: "jpeg" | "png";
  readonly width: number;
  readonly height: number;
  /** Of the view it belongs to: how often the page has connected. */
  readonly connection: number;
}

export interface DebugHook {
  /** The camera the page has asked for last, as proto JSON (radiata.v1.Camera). */
  camera: () => unknown;
  /** The camera of the newest change that the frame on the screen answers, as proto JSON. */
  shownCamera: () => unknown;
  /** The newest request echoed by the server, as proto JSON (radiata.v1.FrameRequest). */
  request: () => unknown;
  lastFrame: () => ShownFrame | null;
  connection: () => string;
}

export const cameraJson = (camera: Camera | null): unknown => (camera ? toJson(CameraSchema, toMessage(camera)) : null);

export const requestJson = (frame: Frame | null): unknown => (frame?.request ? toJson(FrameRequestSchema, frame.request) : null);

export function shownFrame(frame: Frame, format: "jpeg" | "png", connection: number): ShownFrame {
  return {
    sequence: Number(frame.sequence),
    cameraSequence: Number(frame.cameraSequence),
    state: kStateNames[frame.state],
    format,
    width: frame.width,
    height: frame.height,
    connection,
  };
}

export function expose(hook: DebugHook): void {
  Object.defineProperty(globalThis, "radiata", { value: Object.freeze(hook), writable: false });
}
