// Pages, their headers, TLS with HTTP/2, and that nginx keeps to its own folder.
import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { request } from "node:http";
import { connect } from "node:http2";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { call, frameOf, framesOf, trailersOf } from "./support/grpc_web.mjs";
import { startOddUpstream } from "./support/odd_upstream.mjs";
import { freePort, root, runToEnd, scratchFolder, start, startNginx } from "./support/processes.mjs";

const method = "/radiata.v1.OddService/Ok";
const calls = 1500;
let nginx, secure, upstream, certificate;

before(async () => {
  const folder = scratchFolder();
  certificate = [join(folder, "certificate.pem"), join(folder, "key.pem")];
  await runToEnd("openssl", [
    "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-days", "1", "-subj", "/CN=localhost",
    "-addext", "subjectAltName=DNS:localhost", "-out", certificate[0], "-keyout", certificate[1],
  ]);
  const upstreamPort = await freePort();
  upstream = await startOddUpstream(upstreamPort);
  nginx = await startNginx({ upstreamPort });
  secure = await startNginx({ upstreamPort, extra: ["--tls", ...certificate] });
});
after(async () => {
  await nginx?.stop();
  await secure?.stop();
  await upstream?.close();
});

/** fetch() would not let a test choose the name it asks for. */
function statusFor(host) {
  return new Promise((done, fail) => {
    const asked = request({ port: nginx.port, host: "127.0.0.1", path: "/", headers: { host } }, (answer) => {
      answer.resume();
      done(answer.statusCode);
    });
    asked.on("error", fail).end();
  });
}

describe("pages", () => {
  it("come with a policy that allows the page's own scripts only", async () => {
    const page = await fetch(`${nginx.url}/`);
    assert.equal(page.status, 200);
    assert.match(page.headers.get("content-type"), /^text\/html/);
    const policy = page.headers.get("content-security-policy");
    for (const part of ["default-src 'none'", "script-src 'self'", "connect-src 'self'", "frame-ancestors 'none'"]) {
      assert.ok(policy.includes(part), part);
    }
    assert.ok(!policy.includes("unsafe"), policy);
    assert.equal(page.headers.get("x-content-type-options"), "nosniff");
    assert.equal(page.headers.get("access-control-allow-origin"), null);
    const text = await page.text();
    assert.ok(!/<script(?![^>]*\ssrc=)/.test(text), "an inline script");
    assert.ok(!/\sstyle=|\son[a-z]+=/.test(text), "an inline style or handler");
    assert.match(text, /not for diagnostic use/);
  });

  it("name scripts that are there, with their type and policy", async () => {
    const text = await (await fetch(`${nginx.url}/`)).text();
    const scripts = [...text.matchAll(/<script[^>]*\ssrc="([^"]+)"/g)].map((match) => match[1]);
    assert.ok(scripts.length > 0);
    for (const script of scripts) {
      const answer = await fetch(nginx.url + script);
      assert.equal(answer.status, 200);
      assert.match(answer.headers.get("content-type"), /^text\/javascript/);
      assert.ok(answer.headers.get("content-security-policy"));
      await answer.arrayBuffer();
    }
  });

  it("do not reach beyond their folder", async () => {
    for (const path of ["/../package.json", "/..%2fpackage.json", "/%2e%2e/package.json", "/assets/", "/.radiata/", "/nginx.conf"]) {
      const answer = await fetch(nginx.url + path);
      assert.ok(answer.status >= 400, `${path}: ${answer.status}`);
      await answer.arrayBuffer();
    }
  });

  it("are for this machine's names only", async () => {
    assert.equal(await statusFor(`localhost:${nginx.port}`), 200);
    assert.equal(await statusFor("127.0.0.1"), 200);
    assert.equal(await statusFor("elsewhere.example"), 421);
  });
});

describe("TLS and HTTP/2", () => {
  it(`carry ${calls} calls on one connection`, async () => {
    const session = connect(`https://localhost:${secure.port}`, { ca: readFileSync(certificate[0]) });
    await new Promise((done, fail) => session.on("connect", done).on("error", fail));
    assert.equal(session.socket.alpnProtocol, "h2");
    const one = () =>
      new Promise((done, fail) => {
        const stream = session.request({ ":method": "POST", ":path": "/radiata.v1.OddService/Empty", "content-type": "application/grpc-web+proto" });
        const chunks = [];
        stream.on("data", (bytes) => chunks.push(bytes)).on("end", () => done(framesOf(Buffer.concat(chunks)))).on("error", fail);
        stream.end(frameOf(Buffer.alloc(0)));
      });
    for (let i = 0; i < calls / 10; ++i) {
      for (const frames of await Promise.all(Array.from({ length: 10 }, one))) {
        assert.deepEqual(frames.map(trailersOf), [{ "grpc-status": "0" }]);
      }
    }
    session.close();
  });
});

describe("the instance", () => {
  it("keeps pid, logs and temporary files in its own folder", () => {
    const names = readdirSync(nginx.prefix);
    for (const name of ["nginx.conf", "nginx.pid", "logs", "temp"]) assert.ok(names.includes(name), `${name} among ${names}`);
    assert.equal(readFileSync(join(nginx.prefix, "nginx.pid"), "utf8").trim(), String(nginx.child.pid));
  });

  it("ends with SIGTERM, and a second one can take its place", async () => {
    const port = await freePort();
    const arguments_ = ["--prefix", scratchFolder(), "--pages", join(root, "client/web/dist"), "--listen", `127.0.0.1:${port}`,
      "--upstream", "127.0.0.1:1"];
    for (let i = 0; i < 2; ++i) {
      const program = start(join(root, "deploy/nginx/run"), arguments_);
      let answer;
      while (!answer) answer = await call(`http://127.0.0.1:${port}`, method.slice(1)).catch(() => new Promise((done) => setTimeout(done, 50)));
      assert.equal(answer.headers.get("grpc-status"), "14");
      assert.equal(await program.stop(), 0);
    }
  });

  it("refuses in one sentence what it cannot do", async () => {
    const refusal = async (change) => {
      const options = { "--prefix": scratchFolder(), "--pages": join(root, "client/web/dist"), "--listen": "127.0.0.1:1", "--upstream": "127.0.0.1:1", ...change };
      const program = start(join(root, "deploy/nginx/run"), [...Object.entries(options).flat(), "--check"]);
      assert.equal(await program.ended, 2);
      assert.equal(program.output().trim().split("\n").length, 1);
      return program.output();
    };
    assert.match(await refusal({ "--pages": "/nowhere" }), /holds no index.html/);
    assert.match(await refusal({ "--listen": "0.0.0.0:80" }), /not on loopback/);
    assert.match(await refusal({ "--prefix": join(scratchFolder(), "a;b") }), /misread/);
  });
});
