// One update under way, the newest camera wins, every update acknowledges.
import { describe, expect, it } from "vitest";
import { type Camera, toMessage } from "../src/camera/camera";
import { type UpdateMessage, Updates } from "../src/view/updates";

const camera = (height: number): Camera => ({
  eyeMm: [0, 0, 1], targetMm: [0, 0, 0], up: [0, 1, 0], lens: { kind: "orthographic", heightMm: height },
});
const change = (height: number) => ({ camera: toMessage(camera(height)), clientTimeMs: height });

/** A server that answers when told to. */
function server() {
  const sent: UpdateMessage[] = [];
  const answers: { accept: () => void; fail: (error: unknown) => void }[] = [];
  const failures: unknown[] = [];
  const updates = new Updates("view", 0n, {
    send: (message) => {
      sent.push(message);
      return new Promise<void>((accept, fail) => void answers.push({ accept, fail }));
    },
    failed: (error) => void failures.push(error),
  });
  const answer = async (error?: unknown) => {
    const next = answers.shift();
    if (error === undefined) next?.accept();
    else next?.fail(error);
    await new Promise((resolve) => setTimeout(resolve));
  };
  return { sent, failures, updates, answer };
}

describe("updates", () => {
  it("sends a change at once, and of those that come meanwhile the newest only", async () => {
    const { sent, updates, answer } = server();
    for (const height of [1, 2, 3, 4]) updates.push(change(height));
    expect(sent.map((message) => message.clientTimeMs)).toEqual([1]);
    await answer();
    expect(sent.map((message) => message.clientTimeMs)).toEqual([1, 4]);
    expect(sent.map((message) => message.cameraSequence)).toEqual([1n, 2n]);
    await answer();
    expect(sent).toHaveLength(2);
  });

  it("merges a change of size into a waiting camera", async () => {
    const { sent, updates, answer } = server();
    updates.push(change(1));
    updates.push(change(2));
    updates.push({ width: 640, height: 480 });
    await answer();
    expect(sent[1]).toMatchObject({ clientTimeMs: 2, width: 640, height: 480 });
  });

  it("acknowledges with each change, and by itself when nothing changes", async () => {
    const { sent, updates, answer } = server();
    updates.acknowledge(1n);
    expect(sent[0]).toEqual({ viewId: "view", acknowledgedSequence: 1n, cameraSequence: 0n });
    updates.acknowledge(2n);
    updates.push(change(5));
    await answer();
    expect(sent[1]).toMatchObject({ acknowledgedSequence: 2n, cameraSequence: 1n, clientTimeMs: 5 });
    await answer();
    expect(sent).toHaveLength(2);
  });

  it("never acknowledges an older frame again", async () => {
    const { sent, updates, answer } = server();
    updates.acknowledge(7n);
    await answer();
    updates.acknowledge(6n);
    expect(sent).toHaveLength(1);
  });

  it("reports a failed call once and goes on with the next change", async () => {
    const { sent, failures, updates, answer } = server();
    updates.push(change(1));
    updates.push(change(2));
    await answer(new Error("refused"));
    expect(failures).toHaveLength(1);
    expect(sent.map((message) => message.clientTimeMs)).toEqual([1, 2]);
  });

  it("sends and reports nothing after it was stopped", async () => {
    const { sent, failures, updates, answer } = server();
    updates.push(change(1));
    updates.push(change(2));
    updates.stop();
    await answer(new Error("gone"));
    expect(sent).toHaveLength(1);
    expect(failures).toHaveLength(0);
  });
});
