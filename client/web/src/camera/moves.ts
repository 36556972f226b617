// The moves of a camera: orbit, pan, zoom and shift. Pure; angles in degrees, lengths in world mm.
import { type Vec3, add, length, scale, subtract, turn } from "../math/vector";
import { type Camera, cameraFrame } from "./camera";

/** Turned about its target: azimuth about the camera's up axis, then elevation about the new right axis.
 *  Equal to `orbit` of server/model/camera.cpp within 1e-9 mm for cameras some hundred mm away. */
export function orbit(camera: Camera, azimuthDeg: number, elevationDeg: number): Camera {
  const radians = Math.PI / 180;
  const frame = cameraFrame(camera);
  const right = turn(frame.right, frame.up, azimuthDeg * radians);
  const both = (v: Vec3): Vec3 => turn(turn(v, frame.up, azimuthDeg * radians), right, elevationDeg * radians);
  return {
    ...camera,
    eyeMm: add(camera.targetMm, both(subtract(camera.eyeMm, camera.targetMm))),
    up: both(frame.up),
  };
}

/** Height in world mm of the part of the target's plane that the picture shows. */
export function heightAtTarget(camera: Camera): number {
  if (camera.lens.kind === "orthographic") return camera.lens.heightMm;
  const distance = length(subtract(camera.targetMm, camera.eyeMm));
  return 2 * distance * Math.tan((camera.lens.fieldOfViewDeg * Math.PI) / 360);
}

/** Eye and target moved by the same world vector. */
export function shift(camera: Camera, by: Vec3): Camera {
  return { ...camera, eyeMm: add(camera.eyeMm, by), targetMm: add(camera.targetMm, by) };
}

/** What lies at the target's distance follows a pointer that moved by (right, down), in picture heights. */
export function pan(camera: Camera, right: number, down: number): Camera {
  const frame = cameraFrame(camera);
  const height = heightAtTarget(camera);
  return shift(camera, add(scale(frame.right, -right * height), scale(frame.up, down * height)));
}

/** Enlarged by `factor`, keeping the point of the target's plane under (x, y) where it is: offsets from the picture's middle,
 *  right and down, in picture heights. A perspective eye comes closer; an orthographic picture covers less. */
export function zoom(camera: Camera, factor: number, x = 0, y = 0): Camera {
  const bounded = Math.min(Math.max(factor, 0.05), 20);
  const lens = camera.lens;
  if (lens.kind === "orthographic" && !within(lens.heightMm / bounded, 1e-3, 1e5)) return camera;
  const arm = subtract(camera.eyeMm, camera.targetMm);
  if (lens.kind === "perspective" && !within(length(arm) / bounded, 1e-2, 1e7)) return camera;
  const closer: Camera =
    lens.kind === "orthographic"
      ? { ...camera, lens: { kind: "orthographic", heightMm: lens.heightMm / bounded } }
      : { ...camera, eyeMm: add(camera.targetMm, scale(arm, 1 / bounded)) };
  // The point under (x, y) lies x * height from the middle before and after: move by the difference.
  const slack = heightAtTarget(camera) - heightAtTarget(closer);
  const frame = cameraFrame(camera);
  return shift(closer, add(scale(frame.right, x * slack), scale(frame.up, -y * slack)));
}

const within = (value: number, low: number, high: number): boolean => value >= low && value <= high;
