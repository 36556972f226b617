// The camera's moves. The orbit's expected values were printed by server/model/camera.cpp (17 digits); bound: 1e-9 mm.
import { describe, expect, it } from "vitest";
import { type Camera, cameraFrame, fromMessage, toMessage } from "../src/camera/camera";
import { heightAtTarget, orbit, pan, zoom } from "../src/camera/moves";
import { type Vec3, add, dot, length, scale, subtract } from "../src/math/vector";

interface Orbit {
  eye: Vec3; target: Vec3; up: Vec3; azimuth: number; elevation: number; turned: Vec3; turnedUp: Vec3;
}

const orbits: Orbit[] = [
  { eye: [0, 0, 200], target: [0, 0, 0], up: [0, 1, 0], azimuth: 30, elevation: 0,
    turned: [100, 0, 173.20508075688772], turnedUp: [0, 1, 0] },
  { eye: [0, 0, 200], target: [0, 0, 0], up: [0, 1, 0], azimuth: 0, elevation: 25,
    turned: [0, -84.523652348139876, 181.26155740733], turnedUp: [0, 0.90630778703664994, 0.42261826174069944] },
  { eye: [12.5, -340, 41], target: [3, -18, 22], up: [0.1, 0.2, 1], azimuth: -47.5, elevation: 18.25,
    turned: [-225.92467494795179, -236.06417315883419, -42.627854556132277],
    turnedUp: [-0.12602123746098728, -0.15795934367142345, 0.97937096825242609] },
  { eye: [-500, 20, 31], target: [-4, 20, 30], up: [0, 0, 2], azimuth: 200, elevation: -95,
    turned: [-43.626011028176549, 5.2146962160158949, 524.19446986182447],
    turnedUp: [-0.93629062098212268, -0.3407186534216099, -0.08526823717818155] },
  { eye: [1000, 2000, -500], target: [1, 2, 3], up: [0, 1, 1], azimuth: 0.01, elevation: -0.02,
    turned: [999.47047152007326, 2000.4129902273428, -499.41042783076523],
    turnedUp: [-0.22722381627996419, 0.34269684248188553, 0.91155263779340512] },
  { eye: [10, 20, -300], target: [10, 20, 30], up: [0, 3, 0], azimuth: -90, elevation: 89.5,
    turned: [12.879756714463412, -309.98743461117652, 30.000000000000114],
    turnedUp: [0.99996192306417142, 0.0087265354983738774, -1.6653345369377348e-16] },
];

const orthographic: Camera = {
  eyeMm: [12.5, -340, 41], targetMm: [3, -18, 22], up: [0.1, 0.2, 1], lens: { kind: "orthographic", heightMm: 120 },
};
const perspective: Camera = { ...orthographic, lens: { kind: "perspective", fieldOfViewDeg: 30 } };

/** World point of the target's plane seen at (x, y): offsets from the middle, right and down, in picture heights. */
function pointAt(camera: Camera, x: number, y: number): Vec3 {
  const frame = cameraFrame(camera);
  const height = heightAtTarget(camera);
  return add(camera.targetMm, add(scale(frame.right, x * height), scale(frame.up, -y * height)));
}

describe("orbit", () => {
  it.each(orbits)("equals the server's for azimuth $azimuth, elevation $elevation", (o) => {
    const turned = orbit({ ...orthographic, eyeMm: o.eye, targetMm: o.target, up: o.up }, o.azimuth, o.elevation);
    for (const axis of [0, 1, 2] as const) {
      expect(Math.abs(turned.eyeMm[axis] - o.turned[axis])).toBeLessThan(1e-9);
      expect(Math.abs(turned.up[axis] - o.turnedUp[axis])).toBeLessThan(1e-12);
    }
    expect(turned.targetMm).toEqual(o.target);
  });

  it("keeps distance and a unit up direction over ten thousand small turns", () => {
    let camera = orthographic;
    for (let i = 0; i < 10_000; ++i) camera = orbit(camera, 0.7, -0.3);
    const before = length(subtract(orthographic.eyeMm, orthographic.targetMm));
    expect(Math.abs(length(subtract(camera.eyeMm, camera.targetMm)) - before)).toBeLessThan(1e-8);
    expect(Math.abs(length(camera.up) - 1)).toBeLessThan(1e-12);
  });
});

describe.each([["orthographic", orthographic], ["perspective", perspective]] as const)("%s camera", (_, camera) => {
  it("pans so that the point under the pointer follows it", () => {
    const before = pointAt(camera, 0.1, -0.2);
    const after = pointAt(pan(camera, 0.3, 0.15), 0.1 + 0.3, -0.2 + 0.15);
    expect(length(subtract(after, before))).toBeLessThan(1e-9);
  });

  it("zooms about the pointer", () => {
    const closer = zoom(camera, 1.7, 0.4, -0.25);
    expect(Math.abs(heightAtTarget(closer) * 1.7 - heightAtTarget(camera))).toBeLessThan(1e-9);
    expect(length(subtract(pointAt(closer, 0.4, -0.25), pointAt(camera, 0.4, -0.25)))).toBeLessThan(1e-9);
  });

  it("never zooms beyond what a server accepts", () => {
    let nearest = camera;
    let farthest = camera;
    for (let i = 0; i < 500; ++i) {
      nearest = zoom(nearest, 10);
      farthest = zoom(farthest, 0.1);
    }
    expect(heightAtTarget(nearest)).toBeGreaterThan(1e-4);
    expect(Number.isFinite(heightAtTarget(farthest))).toBe(true);
    expect(heightAtTarget(farthest)).toBeLessThan(1e8);
  });

  it("survives the way through the contract", () => {
    expect(fromMessage(toMessage(camera))).toEqual(camera);
  });
});

describe("cameraFrame", () => {
  it("is right-handed and orthonormal", () => {
    const { right, up, forward } = cameraFrame(orthographic);
    for (const axis of [right, up, forward]) expect(Math.abs(length(axis) - 1)).toBeLessThan(1e-12);
    expect(Math.abs(dot(right, up)) + Math.abs(dot(up, forward)) + Math.abs(dot(right, forward))).toBeLessThan(1e-12);
  });
});
