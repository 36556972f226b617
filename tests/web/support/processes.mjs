// Starting and ending the programs under test. Everything started is ended at the end of the test process, whatever happens.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { createServer, connect } from "node:net";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

export const root = resolve(fileURLToPath(import.meta.url), "../../../..");
/** Folder of the built programs; tests/web/CMakeLists.txt names it. */
export const programs = process.env.RADIATA_BIN ?? join(root, "build/release/bin");

const running = new Set();
const folders = new Set();
process.on("exit", () => {
  for (const child of running) child.kill("SIGKILL");
  for (const folder of folders) rmSync(folder, { recursive: true, force: true });
});

export function scratchFolder() {
  const folder = mkdtempSync(join(tmpdir(), "radiata-web-"));
  folders.add(folder);
  return folder;
}

/** A TCP port of 127.0.0.1 that was free a moment ago. */
export async function freePort() {
  const server = createServer();
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  const { port } = server.address();
  await new Promise((done) => server.close(done));
  return port;
}

/** Starts a program; `output()` is what it has written so far, `ended` resolves to its exit status or signal. */
export function start(file, args, options = {}) {
  const child = spawn(file, args, { stdio: ["ignore", "pipe", "pipe"], ...options });
  let text = "";
  for (const stream of [child.stdout, child.stderr]) stream.on("data", (bytes) => (text += bytes));
  running.add(child);
  const ended = new Promise((done) => {
    child.on("error", (error) => done(error.message));
    child.on("close", (code, signal) => {
      running.delete(child);
      done(code ?? signal);
    });
  });
  const stop = async (signal = "SIGTERM") => {
    child.kill(signal);
    const timer = setTimeout(() => child.kill("SIGKILL"), 10_000);
    const status = await ended;
    clearTimeout(timer);
    return status;
  };
  return { child, ended, stop, output: () => text };
}

/** Runs a program to its end. \throws Error with its output unless it exits with 0 */
export async function runToEnd(file, args, options = {}) {
  const program = start(file, args, options);
  const status = await program.ended;
  if (status !== 0) throw new Error(`${file} ${args.join(" ")}: exit status ${status}\n${program.output()}`);
  return program.output();
}

/** Resolves once `condition` gives something true. */
export async function until(what, condition, limit_ms = 20_000) {
  const end = Date.now() + limit_ms;
  for (;;) {
    const value = await condition();
    if (value) return value;
    if (Date.now() > end) throw new Error(`${what}: not within ${limit_ms} ms`);
    await new Promise((done) => setTimeout(done, 50));
  }
}

export function accepts(port) {
  return new Promise((done) => {
    const socket = connect(port, "127.0.0.1");
    socket.on("connect", () => (socket.destroy(), done(true)));
    socket.on("error", () => done(false));
  });
}

/** nginx as people start it. \param extra further options of deploy/nginx/run */
export async function startNginx({ upstreamPort, pages = join(root, "client/web/dist"), extra = [] }) {
  const port = await freePort();
  const prefix = scratchFolder();
  const program = start(join(root, "deploy/nginx/run"), [
    "--prefix", prefix, "--pages", pages, "--listen", `127.0.0.1:${port}`, "--upstream", `127.0.0.1:${upstreamPort}`, ...extra,
  ]);
  await until(`nginx\n${program.output()}`, () => accepts(port));
  return { ...program, port, prefix, url: `http://127.0.0.1:${port}` };
}

/** radiata-server with pictures that take no renderer. */
export async function startStubServer(port, milliseconds = 20) {
  const program = start(join(programs, "radiata-server"), ["--listen", `127.0.0.1:${port}`, "--stub-render", String(milliseconds)]);
  await until(`radiata-server\n${program.output()}`, () => accepts(port));
  return program;
}
