// Waiting times, failures, rates and the texts that people read.
import { Code, ConnectError } from "@connectrpc/connect";
import { describe, expect, it } from "vitest";
import { fit } from "../src/picture/screen";
import { frameTime, milliseconds } from "../src/status/line";
import { FrameRate } from "../src/status/rate";
import { Backoff } from "../src/view/backoff";
import { isViewGone, passes, sentence } from "../src/view/failures";

describe("backoff", () => {
  it("doubles from a quarter of a second to five seconds", () => {
    const backoff = new Backoff(() => 1);
    expect(Array.from({ length: 7 }, () => backoff.next())).toEqual([250, 500, 1000, 2000, 4000, 5000, 5000]);
    backoff.reset();
    expect(backoff.next()).toBe(250);
  });

  it("spreads the attempts of many pages over half of the time", () => {
    expect(new Backoff(() => 0).next()).toBe(125);
  });
});

describe("failures", () => {
  it.each([Code.Unavailable, Code.Unknown, Code.Aborted, Code.Internal, Code.NotFound, Code.DeadlineExceeded, Code.ResourceExhausted])(
    "code %i passes", (code) => expect(passes(new ConnectError("", code))).toBe(true));

  it.each([Code.InvalidArgument, Code.Unimplemented, Code.PermissionDenied, Code.Unauthenticated])(
    "code %i does not pass", (code) => expect(passes(new ConnectError("", code))).toBe(false));

  it("takes a broken network for something that passes", () => {
    expect(passes(new TypeError("network error"))).toBe(true);
  });

  it("knows a view that is gone and tells the server's own sentence", () => {
    const error = new ConnectError("view: no view has this id", Code.NotFound);
    expect(isViewGone(error)).toBe(true);
    expect(sentence(error)).toBe("view: no view has this id");
  });
});

describe("frame rate", () => {
  it("is the mean time between frames", () => {
    const rate = new FrameRate();
    expect(rate.frameMs()).toBeNull();
    for (let i = 0; i < 30; ++i) rate.shown(i * 40);
    expect(rate.frameMs()).toBeCloseTo(40, 9);
  });

  it("does not count pauses", () => {
    const rate = new FrameRate();
    for (const time of [0, 40, 80, 5000, 5020, 5040]) rate.shown(time);
    expect(rate.frameMs()).toBeCloseTo(20, 9);
  });
});

describe("texts", () => {
  it("tell times with the digits that matter", () => {
    expect([milliseconds(4.23), milliseconds(42.3), milliseconds(null), milliseconds(NaN)]).toEqual(["4.2 ms", "42 ms", "–", "–"]);
    expect([frameTime(20), frameTime(400), frameTime(null)]).toEqual(["20 ms (50 fps)", "400 ms (2.5 fps)", "–"]);
  });
});

describe("picture size", () => {
  it("keeps its shape within the server's limits", () => {
    const limits = { widthMax: 4096, heightMax: 4096, pixelsMax: 2_000_000 };
    expect(fit({ width: 1280, height: 720 }, limits)).toEqual({ width: 1280, height: 720 });
    const fitted = fit({ width: 5120, height: 2880 }, limits);
    expect(fitted.width * fitted.height).toBeLessThanOrEqual(2_000_000);
    expect(fitted.width / fitted.height).toBeCloseTo(16 / 9, 2);
  });
});
