// Generates src/generated from the contract in proto/ with the system's protoc (Debian: protobuf-compiler) and
// protoc-gen-es from node_modules. The health service comes from Debian's grpc-proto.
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readdirSync, rmSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const web = resolve(dirname(fileURLToPath(import.meta.url)), "..");
const contract = resolve(web, "../../proto");
const health = process.env.GRPC_PROTO_DIR ?? "/usr/share/grpc-proto";
const out = join(web, "src/generated");
const healthProto = "grpc/health/v1/health.proto";

function fail(sentence) {
  console.error(`generate: ${sentence}`);
  process.exit(1);
}

if (!existsSync(join(health, healthProto))) {
  fail(`${join(health, healthProto)} is missing; install the Debian package grpc-proto or set GRPC_PROTO_DIR`);
}
const protos = readdirSync(join(contract, "radiata/v1"))
  .filter((name) => name.endsWith(".proto"))
  .map((name) => `radiata/v1/${name}`);

rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
try {
  execFileSync(
    "protoc",
    [
      `--plugin=protoc-gen-es=${join(web, "node_modules/.bin/protoc-gen-es")}`,
      `--es_out=${out}`,
      "--es_opt=target=ts",
      "-I", contract,
      "-I", health,
      ...protos,
      healthProto,
    ],
    { stdio: "inherit" },
  );
} catch (error) {
  fail(error.code === "ENOENT" ? "protoc is missing; install the Debian package protobuf-compiler" : error.message);
}
