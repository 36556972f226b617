// What pointers and keys mean.
import { describe, expect, it } from "vitest";
import { Gestures, kDegreesPerHeight, kPressHeights } from "../src/input/gestures";
import { press } from "../src/input/keys";

function recorder() {
  const calls: [string, ...number[]][] = [];
  return {
    calls,
    moves: {
      orbit: (a: number, e: number) => void calls.push(["orbit", a, e]),
      pan: (x: number, y: number) => void calls.push(["pan", x, y]),
      zoom: (f: number, x: number, y: number) => void calls.push(["zoom", f, x, y]),
      pick: (x: number, y: number) => void calls.push(["pick", x, y]),
      slice: (n: number) => void calls.push(["slice", n]),
      reset: () => void calls.push(["reset"]),
    },
  };
}

describe("gestures", () => {
  it("orbits with one pointer: the scene follows it", () => {
    const { calls, moves } = recorder();
    const gestures = new Gestures(moves);
    gestures.down(1, { x: 0, y: 0 }, false);
    gestures.move(1, { x: 0.25, y: -0.125 });
    gestures.up(1);
    gestures.move(1, { x: 1, y: 1 });
    expect(calls).toEqual([["orbit", -0.25 * kDegreesPerHeight, 0.125 * kDegreesPerHeight]]);
  });

  it("picks where a pointer is pressed without moving, and only then", () => {
    const { calls, moves } = recorder();
    const gestures = new Gestures(moves);
    gestures.down(1, { x: 0.1, y: -0.2 }, false);
    gestures.move(1, { x: 0.1 + kPressHeights / 2, y: -0.2 });
    gestures.up(1);
    expect(calls).toEqual([["pick", 0.1, -0.2]]);
    gestures.down(1, { x: 0, y: 0 }, true);  // to pan
    gestures.up(1);
    gestures.down(1, { x: 0, y: 0 }, false);
    gestures.down(2, { x: 0.5, y: 0 }, false);  // a second finger
    gestures.up(2);
    gestures.up(1);
    gestures.down(1, { x: 0, y: 0 }, false);
    gestures.cancel(1);
    gestures.up(1);
    expect(calls.length).toBe(1);
    gestures.down(1, { x: 0, y: 0 }, false);
    gestures.move(1, { x: 0.01, y: 0 });
    gestures.move(1, { x: 0, y: 0 });
    gestures.up(1);
    expect(calls.filter(([what]) => what === "pick").length).toBe(1);
  });

  it("pans with a pointer that was set down to pan", () => {
    const { calls, moves } = recorder();
    const gestures = new Gestures(moves);
    gestures.down(1, { x: 0.5, y: 0.5 }, true);
    gestures.move(1, { x: 0.75, y: 0.25 });
    expect(calls).toEqual([["pan", 0.25, -0.25]]);
  });

  it("pans by the middle of two fingers and zooms by their distance", () => {
    const { calls, moves } = recorder();
    const gestures = new Gestures(moves);
    gestures.down(1, { x: -0.25, y: 0 }, false);
    gestures.down(2, { x: 0.25, y: 0 }, false);
    gestures.move(2, { x: 0.75, y: 0 });
    expect(calls).toEqual([["pan", 0.25, 0], ["zoom", 2, 0.25, 0]]);
  });

  it("goes on orbiting with the finger that stays", () => {
    const { calls, moves } = recorder();
    const gestures = new Gestures(moves);
    gestures.down(1, { x: 0, y: 0 }, false);
    gestures.down(2, { x: 0.5, y: 0 }, false);
    gestures.up(1);
    gestures.move(2, { x: 0.5, y: 0.5 });
    expect(calls).toEqual([["orbit", -0, -0.5 * kDegreesPerHeight]]);
  });

  it("does not divide by the distance of two fingers in one place", () => {
    const { calls, moves } = recorder();
    const gestures = new Gestures(moves);
    gestures.down(1, { x: 0, y: 0 }, false);
    gestures.down(2, { x: 0, y: 0 }, false);
    gestures.move(2, { x: 0.5, y: 0 });
    expect(calls.map(([name]) => name)).toEqual(["pan"]);
  });
});

describe("keys", () => {
  it.each([
    ["ArrowLeft", false, ["orbit", 5, -0]],
    ["ArrowUp", false, ["orbit", -0, 5]],
    ["ArrowRight", true, ["pan", 0.05, 0]],
    ["+", true, ["zoom", 1.15, 0, 0]],
    ["-", false, ["zoom", 1 / 1.15, 0, 0]],
    ["PageUp", false, ["slice", 1]],
    ["PageDown", false, ["slice", -1]],
    ["r", false, ["reset"]],
  ] as const)("%s (shift %s) means %j", (key, shift, expected) => {
    const { calls, moves } = recorder();
    expect(press(key, shift, moves)).toBe(true);
    expect(calls).toEqual([expected]);
  });

  it("leaves other keys alone", () => {
    const { calls, moves } = recorder();
    expect(press("a", false, moves)).toBe(false);
    expect(calls).toEqual([]);
  });
});
