// A server that speaks HTTP/2 and breaks gRPC's rules in the ways that real ones do; the method's name chooses how.
import { createServer } from "node:http2";
import { frameOf } from "./grpc_web.mjs";

const kGrpc = { ":status": 200, "content-type": "application/grpc" };
const status = (code, more = {}) => ({ "grpc-status": String(code), ...more });
export const kLargeBytes = 5_000_000;

function withTrailers(stream, chunks, trailers) {
  stream.respond(kGrpc, { waitForTrailers: true });
  stream.on("wantTrailers", () => stream.sendTrailers(trailers));
  const next = () => {
    const chunk = chunks.shift();
    if (chunk === undefined) stream.end();
    else stream.write(chunk, () => setTimeout(next, 20));
  };
  next();
}

const answers = {
  Ok: (stream) => withTrailers(stream, [frameOf("one"), frameOf("two")], status(0)),
  // A message whose frame comes in pieces: the filter sees several buffers.
  Pieces: (stream) => {
    const frame = frameOf("in pieces");
    withTrailers(stream, [frame.subarray(0, 2), frame.subarray(2, 7), frame.subarray(7)], status(0));
  },
  Empty: (stream) => withTrailers(stream, [], status(0)),
  Large: (stream) => withTrailers(stream, [frameOf(Buffer.alloc(kLargeBytes, 7))], status(0)),
  Refused: (stream) => withTrailers(stream, [], status(3, { "grpc-message": "camera: up is zero, it must not be %C3%A4" })),
  Details: (stream) => withTrailers(stream, [frameOf("some")], status(9, { "grpc-message": "no", "grpc-status-details-bin": "CAkSAm5v" })),
  TrailersOnly: (stream) => stream.respond({ ...kGrpc, ...status(5, { "grpc-message": "dataset \"x\" is not known" }) }, { endStream: true }),
  NoStatus: (stream) => {
    stream.respond(kGrpc);
    stream.end(frameOf("then nothing"));
  },
  NothingAtAll: (stream) => stream.respond(kGrpc, { endStream: true }),
  Page: (stream) => {
    stream.respond({ ":status": 200, "content-type": "text/html" });
    stream.end("<p>hello</p>");
  },
  Busy: (stream) => {
    stream.respond({ ":status": 503, "content-type": "text/plain" });
    stream.end("try later");
  },
  Teapot: (stream) => {
    stream.respond({ ":status": 418, "content-type": "text/plain" });
    stream.end("short and stout");
  },
  Cut: (stream) => {
    stream.respond(kGrpc);
    stream.write(frameOf("the last you hear"), () => setTimeout(() => stream.session.destroy(), 50));
  },
  Echo: (stream, headers) =>
    withTrailers(stream, [frameOf(JSON.stringify({ te: headers.te, type: headers["content-type"] }))], status(0)),
};

/** \return {close} */
export async function startOddUpstream(port) {
  const server = createServer();
  const sessions = new Set();
  server.on("session", (session) => {
    sessions.add(session);
    session.on("close", () => sessions.delete(session));
    session.on("error", () => {});
  });
  server.on("stream", (stream, headers) => {
    stream.on("error", () => {});
    stream.resume();
    const method = headers[":path"].split("/").pop();
    const answer = answers[method] ?? ((s) => s.respond({ ...kGrpc, ...status(12) }, { endStream: true }));
    answer(stream, headers);
  });
  await new Promise((done) => server.listen(port, "127.0.0.1", done));
  return {
    close: () => {
      for (const session of sessions) session.destroy();
      return new Promise((done) => server.close(done));
    },
  };
}
