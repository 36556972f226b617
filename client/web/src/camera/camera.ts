// From where a scene is seen: plain values, world space, mm. Mirrors server/model/camera.h.
import { create } from "@bufbuild/protobuf";
import { type Camera as CameraMessage, CameraSchema } from "../generated/radiata/v1/camera_pb";
import { type Vec3, cross, normalize, subtract } from "../math/vector";

export type Lens =
  | { readonly kind: "perspective"; readonly fieldOfViewDeg: number }
  | { readonly kind: "orthographic"; readonly heightMm: number };

export interface Camera {
  readonly eyeMm: Vec3;
  readonly targetMm: Vec3;
  readonly up: Vec3;
  readonly lens: Lens;
  readonly clip?: { readonly nearestMm: number; readonly farthestMm: number };
}

/** The camera's axes in world space: unit, right-handed; `forward` points into the picture. */
export interface CameraFrame {
  readonly right: Vec3;
  readonly up: Vec3;
  readonly forward: Vec3;
}

export function cameraFrame(camera: Camera): CameraFrame {
  const forward = normalize(subtract(camera.targetMm, camera.eyeMm));
  const right = normalize(cross(forward, normalize(camera.up)));
  return { right, up: cross(right, forward), forward };
}

const vector = (v: Vec3) => ({ x: v[0], y: v[1], z: v[2] });

export function toMessage(camera: Camera): CameraMessage {
  return create(CameraSchema, {
    eyeMm: vector(camera.eyeMm),
    targetMm: vector(camera.targetMm),
    up: vector(camera.up),
    lens:
      camera.lens.kind === "perspective"
        ? { case: "fieldOfViewDeg", value: camera.lens.fieldOfViewDeg }
        : { case: "heightMm", value: camera.lens.heightMm },
    clip: camera.clip && { nearestMm: camera.clip.nearestMm, farthestMm: camera.clip.farthestMm },
  });
}

/** \throws Error if the message has no eye, target, up or lens. */
export function fromMessage(message: CameraMessage): Camera {
  const { eyeMm, targetMm, up, lens, clip } = message;
  if (!eyeMm || !targetMm || !up || lens.case === undefined) {
    throw new Error("The server sent a camera without eye, target, up direction or lens.");
  }
  return {
    eyeMm: [eyeMm.x, eyeMm.y, eyeMm.z],
    targetMm: [targetMm.x, targetMm.y, targetMm.z],
    up: [up.x, up.y, up.z],
    lens:
      lens.case === "fieldOfViewDeg"
        ? { kind: "perspective", fieldOfViewDeg: lens.value }
        : { kind: "orthographic", heightMm: lens.value },
    ...(clip && { clip: { nearestMm: clip.nearestMm, farthestMm: clip.farthestMm } }),
  };
}
