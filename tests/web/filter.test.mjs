// The gRPC-Web trailer filter and nginx's refusals, against a server that behaves oddly.
import assert from "node:assert/strict";
import { connect } from "node:net";
import { after, before, describe, it } from "node:test";
import { call } from "./support/grpc_web.mjs";
import { kLargeBytes, startOddUpstream } from "./support/odd_upstream.mjs";
import { freePort, startNginx } from "./support/processes.mjs";

const odd = (method) => `radiata.v1.OddService/${method}`;
let nginx, upstream, upstreamPort;

before(async () => {
  upstreamPort = await freePort();
  upstream = await startOddUpstream(upstreamPort);
  nginx = await startNginx({ upstreamPort });
});
after(async () => {
  await nginx?.stop();
  await upstream?.close();
});

describe("the trailer filter", () => {
  it("appends the trailers once, after the last message", async () => {
    const answer = await call(nginx.url, odd("Ok"));
    assert.equal(answer.http, 200);
    assert.equal(answer.headers.get("content-type"), "application/grpc-web+proto");
    assert.deepEqual(answer.messages.map(String), ["one", "two"]);
    assert.deepEqual(answer.trailers, [{ "grpc-status": "0" }]);
    assert.ok(answer.endsWithTrailer);
  });

  it("leaves a message that comes in pieces whole", async () => {
    const answer = await call(nginx.url, odd("Pieces"));
    assert.deepEqual(answer.messages.map(String), ["in pieces"]);
    assert.deepEqual(answer.trailers, [{ "grpc-status": "0" }]);
  });

  it("passes five megabytes unchanged", async () => {
    const answer = await call(nginx.url, odd("Large"));
    assert.equal(answer.messages.length, 1);
    assert.equal(answer.messages[0].length, kLargeBytes);
    assert.ok(answer.messages[0].every((byte) => byte === 7));
    assert.deepEqual(answer.trailers, [{ "grpc-status": "0" }]);
  });

  it("answers without a message with the trailers alone", async () => {
    const answer = await call(nginx.url, odd("Empty"));
    assert.deepEqual(answer.messages, []);
    assert.deepEqual(answer.trailers, [{ "grpc-status": "0" }]);
  });

  it("keeps the message of a refused request as it was encoded", async () => {
    const answer = await call(nginx.url, odd("Refused"));
    assert.deepEqual(answer.trailers, [{ "grpc-status": "3", "grpc-message": "camera: up is zero, it must not be %C3%A4" }]);
  });

  it("forwards the details of a status", async () => {
    const answer = await call(nginx.url, odd("Details"));
    assert.deepEqual(answer.trailers, [{ "grpc-status": "9", "grpc-message": "no", "grpc-status-details-bin": "CAkSAm5v" }]);
  });

  it("appends nothing when the status is among the headers already", async () => {
    const answer = await call(nginx.url, odd("TrailersOnly"));
    assert.equal(answer.headers.get("grpc-status"), "5");
    assert.equal(answer.headers.get("grpc-message"), 'dataset "x" is not known');
    assert.deepEqual([answer.messages, answer.trailers], [[], []]);
  });

  it("passes on that a method is unknown", async () => {
    const answer = await call(nginx.url, odd("NoSuchMethod"));
    assert.equal(answer.headers.get("grpc-status"), "12");
  });

  it("says unavailable when the answer ends without a status", async () => {
    const answer = await call(nginx.url, odd("NoStatus"));
    assert.deepEqual(answer.messages.map(String), ["then nothing"]);
    assert.deepEqual(answer.trailers, [{ "grpc-status": "14", "grpc-message": "the answer ended without a status" }]);
    const nothing = await call(nginx.url, odd("NothingAtAll"));
    assert.equal(nothing.trailers[0]?.["grpc-status"], "14");
  });

  it("turns answers that are not gRPC into a status without a body", async () => {
    const page = await call(nginx.url, odd("Page"));
    assert.deepEqual([page.http, page.headers.get("grpc-status"), page.messages], [200, "2", []]);
    const teapot = await call(nginx.url, odd("Teapot"));
    assert.equal(teapot.headers.get("grpc-status"), "2");
    assert.match(teapot.headers.get("grpc-message"), /HTTP status 418/);
    const busy = await call(nginx.url, odd("Busy"));
    assert.deepEqual([busy.http, busy.headers.get("grpc-status")], [200, "14"]);
  });

  it("breaks off when the server dies in mid-stream, and never invents an end", async () => {
    await assert.rejects(call(nginx.url, odd("Cut")));
  });

  it("asks the server for trailers, in gRPC's content type", async () => {
    const answer = await call(nginx.url, odd("Echo"));
    assert.deepEqual(JSON.parse(String(answer.messages[0])), { te: "trailers", type: "application/grpc" });
  });
});

describe("requests that never reach the server", () => {
  it("too large: resource exhausted", async () => {
    const answer = await call(nginx.url, odd("Ok"), { message: Buffer.alloc(2_000_000) });
    assert.deepEqual([answer.http, answer.headers.get("grpc-status")], [200, "8"]);
  });

  it("another content type, such as a form of another site can send: unimplemented", async () => {
    for (const type of ["text/plain", "application/x-www-form-urlencoded", "application/grpc"]) {
      const answer = await call(nginx.url, odd("Ok"), { headers: { "content-type": type } });
      assert.deepEqual([answer.headers.get("grpc-status"), answer.messages], ["12", []], type);
    }
  });

  it("GET, or a question for permission from another origin: denied, without cross-origin headers", async () => {
    for (const method of ["GET", "OPTIONS"]) {
      const answer = await fetch(`${nginx.url}/${odd("Ok")}`, { method, headers: { origin: "http://elsewhere.example" } });
      assert.notEqual(answer.headers.get("grpc-status"), "0");
      assert.equal(answer.headers.get("access-control-allow-origin"), null);
      assert.equal((await answer.arrayBuffer()).byteLength, 0);
    }
  });

  it("bytes that are no HTTP: refused, and the next request works", async () => {
    const socket = connect(nginx.port, "127.0.0.1");
    socket.on("error", () => {});
    socket.write(Buffer.from([0, 255, 1, 2, 13, 10, 13, 10]));
    await new Promise((done) => socket.on("close", done).resume());
    assert.deepEqual((await call(nginx.url, odd("Ok"))).trailers, [{ "grpc-status": "0" }]);
  });

  it("server down: unavailable, and available again as soon as it is back", async () => {
    await upstream.close();
    for (let i = 0; i < 5; ++i) {
      const answer = await call(nginx.url, odd("Ok"));
      assert.deepEqual([answer.http, answer.headers.get("grpc-status"), answer.messages], [200, "14", []]);
      assert.equal(answer.headers.get("content-type"), "application/grpc-web+proto");
    }
    upstream = await startOddUpstream(upstreamPort);
    assert.deepEqual((await call(nginx.url, odd("Ok"))).trailers, [{ "grpc-status": "0" }]);
  });
});
