// Real glyphs of a small sample brain: what the page shows is what `radiata render` and `radiata orbit` give.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { camera, compare, converged, keep, nativeOptions, openPage } from "./support/browser.mjs";
import { accepts, freePort, programs, runToEnd, scratchFolder, start, startNginx, until } from "./support/processes.mjs";

const kStateMark = [[0, 0, 1, 0.25]];
const kSize = { width: 480, height: 360 };
const folder = scratchFolder();
let port, server, nginx, browser, page;

before(async () => {
  const brain = join(folder, "brain.nii.gz");
  await runToEnd(join(programs, "radiata-phantom"), [brain, "--seed", "5", "--size", "28", "--lmax", "6"]);
  port = await freePort();
  server = start(join(programs, "radiata-server"), [
    "--listen", `127.0.0.1:${port}`, "--data", brain, "--pipeline-cache", join(folder, "pipelines"),
  ]);
  await until("radiata-server", async () => {
    if (await Promise.race([server.ended, false])) throw new Error(server.output());
    return accepts(port);
  }, 120_000);
  nginx = await startNginx({ upstreamPort: port });
  browser = await openPage(nginx.url, kSize);
  page = browser.page;
  await converged(page, 120_000);
});
after(async () => {
  await browser?.close();
  await nginx?.stop();
  await server?.stop();
});

const native = async (command, cameraJson, output, extra = []) =>
  runToEnd(join(programs, "radiata"), [
    "--server", `127.0.0.1:${port}`, command, "--camera", JSON.stringify(cameraJson), ...(await nativeOptions(page)), "-o", output, ...extra,
  ]);

describe("real glyphs", () => {
  it("are in the page pixel for pixel as `radiata render` gives them, once converged", async () => {
    await keep(page);
    const lit = await page.evaluate(() => {
      let count = 0;
      for (let i = 0; i < kept.data.length; i += 4) count += kept.data[i] + kept.data[i + 1] + kept.data[i + 2] > 60 ? 1 : 0;
      return count / (kept.width * kept.height);
    });
    assert.ok(lit > 0.02, `only ${lit} of the pixels show something`);
    const file = join(folder, "still.png");
    await native("render", await camera(page), file);
    const result = await compare(page, readFileSync(file), "image/png");
    assert.equal(result.different, 0, JSON.stringify(result));
  });

  it("are the native client's while the view moves, within the bound of JPEG", async () => {
    await page.evaluate(() => {
      globalThis.moving = new Promise((done) => {
        const look = () => {
          if (radiata.lastFrame().state !== "interactive") return setTimeout(look, 1);
          const canvas = document.getElementById("picture");
          globalThis.kept = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
          done(radiata.shownCamera());
        };
        look();
      });
      dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft" }));
    });
    const shown = await page.evaluate(() => globalThis.moving);
    const [jpeg, png] = [join(folder, "moving.jpg"), join(folder, "moving.png")];
    await native("render", shown, jpeg, ["--samples", "1"]);
    await native("render", shown, png, ["--samples", "1"]);
    const same = await compare(page, readFileSync(jpeg), "image/jpeg", kStateMark);
    assert.equal(same.different, 0, JSON.stringify(same));
    const lossless = await compare(page, readFileSync(png), "image/png", kStateMark);
    assert.ok(lossless.psnr > 30, JSON.stringify(lossless));
    await converged(page, 120_000);
  });

  it("turn by the mouse as by `radiata orbit`", async () => {
    const from = await camera(page);
    await keep(page);
    const box = await page.locator("#picture").boundingBox();
    const at = { x: box.x + 100, y: box.y + box.height / 2 };
    await page.mouse.move(at.x, at.y);
    await page.mouse.down();
    await page.mouse.move(at.x + 60, at.y - 30);
    await page.mouse.up();
    await converged(page, 120_000);
    const turn = ["--frames", "2", "--azimuth", String((-60 / box.height) * 180), "--elevation", String((30 / box.height) * 180)];
    await native("orbit", from, join(folder, "orbit"), [...turn, "--quiet"]);
    const bytes = readFileSync(join(folder, "orbit/frame-0002.png"));
    const before = await compare(page, bytes, "image/png");
    assert.ok(before.different > 0.02 * before.width * before.height, JSON.stringify(before));
    await keep(page);
    // The last bits of the two cameras may differ, and with them single pixels at the glyphs' outlines.
    const after_ = await compare(page, bytes, "image/png");
    assert.ok(after_.psnr > 50, JSON.stringify(after_));
  });

  it("left nothing wrong in the page", () => assert.deepEqual(browser.problems, []));
});
