// A read-only look into the page for its tests and for curious people: `window.radiata`. Nothing of the page depends on it.
import { toJson } from "@bufbuild/protobuf";
import { type Camera } from "./camera/camera";
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
  /** The camera the page has asked for last, in the format of the camera files that the other clients read. */
  camera: () => unknown;
  /** The camera that the frame on the screen shows. */
  shownCamera: () => unknown;
  /** The newest request echoed by the server, as proto JSON (radiata.v1.FrameRequest). */
  request: () => unknown;
  lastFrame: () => ShownFrame | null;
  connection: () => string;
}

export function cameraJson(camera: Camera | null | undefined): unknown {
  if (!camera) return null;
  return {
    eye_mm: camera.eyeMm,
    target_mm: camera.targetMm,
    up: camera.up,
    ...(camera.lens.kind === "perspective" ? { field_of_view_deg: camera.lens.fieldOfViewDeg } : { height_mm: camera.lens.heightMm }),
    ...(camera.clip && { clip: { nearest_mm: camera.clip.nearestMm, farthest_mm: camera.clip.farthestMm } }),
  };
}

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
