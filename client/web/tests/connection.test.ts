// Opening a view, and opening it again, against a server in memory.
import { create } from "@bufbuild/protobuf";
import { Code, ConnectError, createRouterTransport } from "@connectrpc/connect";
import { describe, expect, it } from "vitest";
import { Health, HealthCheckResponse_ServingStatus as ServingStatus } from "../src/generated/grpc/health/v1/health_pb";
import { type Frame, type FrameRequest } from "../src/generated/radiata/v1/frame_pb";
import { type OpenRequest, OpenResponseSchema, type UpdateRequest, ViewService } from "../src/generated/radiata/v1/view_pb";
import { servicesOver } from "../src/service";
import { Connection } from "../src/view/connection";

/** What the test's server does; each may be replaced in mid-test. */
interface Behaviour {
  serving: boolean;
  /** Sends frames until it returns or throws; runs after the view's id has gone. */
  stream: (signal: AbortSignal) => AsyncGenerator<number>;
  beforeId: () => Promise<void>;
  update: (request: UpdateRequest) => void;
}

async function* untilAborted(signal: AbortSignal): AsyncGenerator<number> {
  yield 1;
  await new Promise((done) => signal.addEventListener("abort", done));
}

function setUp(change: Partial<Behaviour> = {}) {
  const behaviour: Behaviour = {
    serving: true, stream: untilAborted, beforeId: async () => {}, update: () => {}, ...change,
  };
  const opened: OpenRequest[] = [];
  const updates: UpdateRequest[] = [];
  const states: string[] = [];
  const refusals: string[] = [];
  const frames: bigint[] = [];
  const transport = createRouterTransport(({ service }) => {
    service(Health, {
      check: () => ({ status: behaviour.serving ? ServingStatus.SERVING : ServingStatus.NOT_SERVING }),
    });
    service(ViewService, {
      async *open(request, context) {
        opened.push(request);
        await behaviour.beforeId();
        yield create(OpenResponseSchema, { viewId: `view-${opened.length}` });
        for await (const sequence of behaviour.stream(context.signal)) {
          yield create(OpenResponseSchema, { frame: { sequence: BigInt(sequence) } });
        }
      },
      update(request) {
        updates.push(request);
        behaviour.update(request);
        return {};
      },
    });
  });
  const connection = new Connection(servicesOver(transport), {
    prepare: async () => {},
    request: () => ({ width: 64, height: 48 }) as FrameRequest,
    frame: (frame: Frame, acknowledge) => {
      frames.push(frame.sequence);
      acknowledge();
    },
    state: (state) => void states.push(state),
    refused: (reason) => void refusals.push(reason),
    numbered: () => {},
  });
  const run = async (done: () => boolean) => {
    const running = connection.run();
    const end = Date.now() + 4000;
    while (!done() && Date.now() < end) await new Promise((resolve) => setTimeout(resolve, 5));
    const held = done();
    connection.close();
    await running;
    expect(held).toBe(true);
  };
  return { behaviour, connection, opened, updates, states, refusals, frames, run };
}

describe("connection", () => {
  it("opens a view, hands on its frames and acknowledges them", async () => {
    const test = setUp();
    await test.run(() => test.updates.length === 1);
    expect(test.states).toEqual(["connecting", "connected"]);
    expect(test.opened[0]?.frame).toMatchObject({ width: 64, height: 48 });
    expect(test.updates[0]).toMatchObject({ viewId: "view-1", acknowledgedSequence: 1n, cameraSequence: 0n });
  });

  it("sends what changed between the request and the opening", async () => {
    const test = setUp({ beforeId: async () => test.connection.change({ width: 32, height: 24 }) });
    await test.run(() => test.updates.some((update) => update.width === 32));
    expect(test.updates.find((update) => update.width === 32)).toMatchObject({ viewId: "view-1", cameraSequence: 1n });
  });

  it("opens no view before the server says that it serves", async () => {
    const test = setUp({ serving: false });
    setTimeout(() => (test.behaviour.serving = true), 300);
    await test.run(() => test.frames.length > 0);
    expect(test.states.slice(0, 2)).toEqual(["connecting", "reconnecting"]);
    expect(test.opened).toHaveLength(1);
  });

  it.each([
    ["breaks", new ConnectError("terminated", Code.Unknown)],
    ["says it is unavailable", new ConnectError("going down", Code.Unavailable)],
    ["ends the stream", null],
  ])("opens a new view when the server %s", async (_, error) => {
    const test = setUp({
      stream: async function* (signal) {
        if (test.opened.length > 1) return yield* untilAborted(signal);
        yield 1;
        if (error) throw error;
      },
    });
    await test.run(() => test.frames.length === 2);
    expect(test.states).toEqual(["connecting", "connected", "reconnecting", "connected"]);
  });

  it("opens a new view when an update finds the old one gone", async () => {
    const test = setUp({
      update: ({ viewId }) => {
        if (viewId === "view-1") throw new ConnectError("no view has this id", Code.NotFound);
      },
    });
    await test.run(() => test.opened.length === 2 && test.updates.some(({ viewId }) => viewId === "view-2"));
    expect(test.states).toContain("reconnecting");
  });

  it("keeps the view when an update is refused, and tells why", async () => {
    const test = setUp({
      update: ({ width }) => {
        if (width > 1000) throw new ConnectError("width is 5000; the limit is 1000", Code.InvalidArgument);
      },
    });
    const running = test.run(() => test.refusals.length === 1);
    setTimeout(() => test.connection.change({ width: 5000, height: 10 }), 100);
    await running;
    expect(test.refusals).toEqual(["width is 5000; the limit is 1000"]);
    expect(test.opened).toHaveLength(1);
  });

  it("waits for a change, not for a pause, after the view itself was refused", async () => {
    const test = setUp({
      beforeId: async () => {
        if (test.opened.length === 1) throw new ConnectError("up is zero", Code.InvalidArgument);
      },
    });
    setTimeout(() => expect(test.opened).toHaveLength(1), 400);
    setTimeout(() => test.connection.change({ width: 10, height: 10 }), 600);
    await test.run(() => test.frames.length > 0);
    expect(test.states).toEqual(["connecting", "refused", "connected"]);
    expect(test.opened).toHaveLength(2);
  });
});
