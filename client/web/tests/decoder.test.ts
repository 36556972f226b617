// Frames are shown in order, and those that newer ones overtake are dropped.
import { create } from "@bufbuild/protobuf";
import { describe, expect, it } from "vitest";
import { type Frame, FrameSchema } from "../src/generated/radiata/v1/frame_pb";
import { Decoder } from "../src/picture/decoder";

const frame = (sequence: number): Frame => create(FrameSchema, { sequence: BigInt(sequence) });

function setUp() {
  const shown: number[] = [];
  const done: number[] = [];
  const failed: number[] = [];
  const decoding: ((result: Error | string) => void)[] = [];
  const decoder = new Decoder<string>({
    decode: () =>
      new Promise((resolve, reject) => {
        decoding.push((result) => (result instanceof Error ? reject(result) : resolve(result)));
      }),
    show: ({ frame }) => void shown.push(Number(frame.sequence)),
    failed: (frame) => void failed.push(Number(frame.sequence)),
  });
  const push = (sequence: number) => decoder.push(frame(sequence), () => void done.push(sequence));
  const finish = async (result: Error | string = "bitmap") => {
    decoding.shift()?.(result);
    await new Promise((resolve) => setTimeout(resolve));
  };
  return { decoder, shown, done, failed, push, finish };
}

describe("decoder", () => {
  it("drops what a newer frame overtakes while another is decoded", async () => {
    const { decoder, shown, done, push, finish } = setUp();
    for (const sequence of [1, 2, 3, 4]) push(sequence);
    await finish();
    await finish();
    expect(shown).toEqual([1, 4]);
    expect(done).toEqual([2, 3, 1, 4]);
    expect(decoder.dropped).toBe(2);
  });

  it("shows nothing of a view that has ended", async () => {
    const { decoder, shown, push, finish } = setUp();
    push(8);
    push(9);
    decoder.reset();
    await finish();
    push(1);
    await finish();
    expect(shown).toEqual([1]);
  });

  it("goes on after a frame that cannot be decoded, and acknowledges it", async () => {
    const { shown, done, failed, push, finish } = setUp();
    push(1);
    push(2);
    await finish(new Error("no picture"));
    await finish();
    expect(failed).toEqual([1]);
    expect(shown).toEqual([2]);
    expect(done).toEqual([1, 2]);
  });
});
