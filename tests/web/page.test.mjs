// The page in Chromium against radiata-server (without a renderer: each picture is a pattern that depends on the camera) through
// nginx: what it shows, how it moves, and what it does when the server goes away.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { camera, compare, converged, keep, lastFrame, nativeOptions, openPage, slicePosition } from "./support/browser.mjs";
import { freePort, programs, runToEnd, scratchFolder, startNginx, startStubServer, until } from "./support/processes.mjs";

/** Where the server writes how far a picture is; that differs between pictures of one camera. */
const kStateMark = [[0, 0, 1, 0.2]];
const folder = scratchFolder();
let serverPort, server, nginx, browser, page;

before(async () => {
  serverPort = await freePort();
  server = await startStubServer(serverPort);
  nginx = await startNginx({ upstreamPort: serverPort });
  browser = await openPage(nginx.url);
  page = browser.page;
  await converged(page);
});
after(async () => {
  await browser?.close();
  await nginx?.stop();
  await server?.stop();
});

/** What the native client makes with the page's choices: `radiata COMMAND` with this camera. */
const native = async (command, cameraJson, output, extra = []) =>
  runToEnd(join(programs, "radiata"), [
    "--server", `127.0.0.1:${serverPort}`, command, "--camera", JSON.stringify(cameraJson), ...(await nativeOptions(page)), "-o", output, ...extra,
  ]);
const picture = () => page.locator("#picture");
const middle = async () => {
  const box = await picture().boundingBox();
  return { x: box.x + box.width / 3, y: box.y + box.height / 2, height: box.height };
};

describe("the page", () => {
  it("connects, fills the window pixel for pixel, and says so in the status line", async () => {
    const box = await picture().boundingBox();
    const frame = await lastFrame(page);
    assert.deepEqual([frame.width, frame.height], [Math.round(box.width), Math.round(box.height)]);
    assert.equal(frame.format, "png");
    assert.equal(await page.textContent("#status-connection"), "connected");
    assert.match(await page.textContent("#status-state"), /^converged, 16 samples$/);
    assert.match(await page.textContent("#status-render"), /^[\d.]+ ms$/);
    assert.match(await page.textContent("footer"), /not for diagnostic use/);
  });

  it("shows exactly what `radiata render` gives, once converged", async () => {
    await keep(page);
    const file = join(folder, "still.png");
    await native("render", await camera(page), file);
    const result = await compare(page, readFileSync(file), "image/png");
    assert.equal(result.different, 0, JSON.stringify(result));
  });

  it("shows exactly what the live view of `radiata render --stream` gives", async () => {
    await keep(page);
    const file = join(folder, "stream.png");
    await native("render", await camera(page), file, ["--stream"]);
    const result = await compare(page, readFileSync(file), "image/png");
    assert.equal(result.different, 0, JSON.stringify(result));
  });

  it("shows the native client's JPEG while it moves, which is within the bound of JPEG of the lossless picture", async () => {
    await picture().focus();
    await page.evaluate(() => {
      // Kept in the same turn as it is seen, before the next frame can be drawn.
      globalThis.moving = new Promise((done) => {
        const look = () => {
          if (radiata.lastFrame().state !== "interactive") return setTimeout(look, 1);
          const canvas = document.getElementById("picture");
          globalThis.kept = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
          done({ format: radiata.lastFrame().format, camera: radiata.shownCamera() });
        };
        look();
      });
    });
    await page.keyboard.press("ArrowLeft");
    const seen = await page.evaluate(() => globalThis.moving);
    assert.equal(seen.format, "jpeg");
    const [jpeg, png] = [join(folder, "moving.jpg"), join(folder, "moving.png")];
    await native("render", seen.camera, jpeg, ["--samples", "1"]);
    await native("render", seen.camera, png, ["--samples", "1"]);
    const same = await compare(page, readFileSync(jpeg), "image/jpeg", kStateMark);
    assert.equal(same.different, 0, JSON.stringify(same));
    const lossless = await compare(page, readFileSync(png), "image/png", kStateMark);
    assert.ok(lossless.psnr > 36, JSON.stringify(lossless));
    await converged(page);
    assert.match(await page.textContent("#status-age"), /^[\d.]+ ms$/);
  });

  it("turns by the mouse as `radiata orbit` does", async () => {
    const start = await camera(page);
    await keep(page);
    const at = await middle();
    await page.mouse.move(at.x, at.y);
    await page.mouse.down();
    await page.mouse.move(at.x + 90, at.y - 40);
    await page.mouse.up();
    await converged(page);
    const turned = await camera(page);
    const path = join(folder, "path.json");
    await native("orbit", start, join(folder, "orbit"), [
      "--frames", "2", "--azimuth", String((-90 / at.height) * 180), "--elevation", String((40 / at.height) * 180),
      "--write-path", path, "--quiet",
    ]);
    const cameras = JSON.parse(readFileSync(path, "utf8"));
    const expected = (cameras.cameras ?? cameras)[1];
    for (const key of ["eye_mm", "target_mm", "up"]) {
      turned[key].forEach((value, i) => assert.ok(Math.abs(value - expected[key][i]) < 1e-9, `${key}: ${turned[key]}, ${expected[key]}`));
    }
    const bytes = readFileSync(join(folder, "orbit/frame-0002.png"));
    assert.ok((await compare(page, bytes, "image/png")).different > 1000, "the picture did not change");
    await keep(page);
    assert.ok((await compare(page, bytes, "image/png")).worst <= 1);
  });

  it("says what lies under a pixel that is clicked, and leaves the camera where it is", async () => {
    const start = await camera(page);
    const box = await picture().boundingBox();
    const row = (name) => page.textContent(`#picked dd[data-row="${name}"]`);
    assert.equal(await page.isVisible("#picked"), false);
    // The left half of the stub's pictures is one glyph whose voxel is the pixel.
    // The middle of the pixel, wherever the picture begins and however little it is scaled.
    await page.mouse.click(box.x + 321.5, box.y + 123.5);
    await page.waitForSelector("#picked:not([hidden])");
    assert.equal(await row("voxel"), "321, 123, 0");
    assert.equal(await row("direction"), "0.000, 0.600, 0.800");
    assert.equal(await row("amplitude"), "0.3804");
    assert.equal(await row("peak"), "1 of 1, 53.1° away, 0.5552");
    const position = (await row("place, mm")).split(", ").map(Number);
    assert.ok(Math.abs(position[0] - (-90 + 2 * 321)) < 0.01, position.join());
    await page.mouse.click(box.x + box.width * 0.6, box.y + 123);
    await page.waitForFunction(() => document.querySelector("#picked h2").textContent === "nothing here");
    assert.equal(await page.locator("#picked dd").count(), 0);
    await page.click("#picked button");
    assert.equal(await page.isVisible("#picked"), false);
    assert.deepEqual(await camera(page), start);
  });

  it("zooms by the wheel and pans with Shift", async () => {
    const start = await camera(page);
    const at = await middle();
    await page.mouse.move(at.x, at.y);
    await page.mouse.wheel(0, -100);
    await page.waitForFunction((height) => radiata.camera().height_mm < height, start.height_mm);
    const zoomed = await camera(page);
    await page.keyboard.down("Shift");
    await page.mouse.down();
    await page.mouse.move(at.x + 50, at.y);
    await page.mouse.up();
    await page.keyboard.up("Shift");
    const panned = await camera(page);
    const moved = Math.hypot(...panned.target_mm.map((value, i) => value - zoomed.target_mm[i]));
    assert.ok(Math.abs(moved - (50 / at.height) * zoomed.height_mm) < 1e-6);
    assert.deepEqual(panned.up, zoomed.up);
    await converged(page);
  });

  it("steps through the slices, and R resets the camera", async () => {
    const before = await slicePosition(page);
    const target = (await camera(page)).target_mm;
    await page.keyboard.press("PageUp");
    // The stub's voxels are 2 mm.
    await until("the next slice", async () => Math.abs((await slicePosition(page))[2] - before[2] - 2) < 1e-9);
    assert.ok(Math.abs((await camera(page)).target_mm[2] - target[2] - 2) < 1e-9);
    await page.keyboard.press("PageDown");
    await page.keyboard.press("r");
    await converged(page);
    assert.deepEqual((await camera(page)).up.map(Math.abs), [0, 1, 0]);
  });

  it("carries the controls into the scene", async () => {
    await page.selectOption("#plane", "coronal");
    await page.selectOption("#region", "slab");
    await page.fill("#thickness", "7.5");
    await page.locator("#thickness").blur();
    await page.selectOption("#scale", "glyph");
    await page.selectOption("#lmax", "0");
    await page.check("#negative");
    await page.selectOption("#convention", "neurological");
    await page.waitForFunction(() => radiata.request().scene.annotations?.convention === "CONVENTION_NEUROLOGICAL");
    const scene = await page.evaluate(() => radiata.request().scene);
    const glyphs = scene.layers[0].glyphs;
    assert.equal(glyphs.selection.slab.thicknessMm, 7.5);
    assert.equal(glyphs.selection.slab.middle.plane, "PLANE_CORONAL");
    assert.deepEqual([glyphs.scale.mode, glyphs.lmax, glyphs.negativeLobes], ["MODE_PER_GLYPH", 0, "NEGATIVE_LOBES_SHOWN"]);
    await page.selectOption("#region", "volume");
    await page.waitForFunction(() => radiata.request().scene.layers[0].glyphs.selection.volume);
    assert.equal(await page.isVisible("#position"), false);
    await page.selectOption("#region", "slice");
    await page.selectOption("#plane", "axial");
    await page.waitForFunction(() => radiata.request().scene.layers[0].glyphs.selection.slice?.plane === "PLANE_AXIAL");
    await converged(page);
  });

  it("tells why an update was refused, and goes on", async () => {
    await page.fill("#factor", "9999999");
    await page.locator("#factor").blur();
    await page.locator("#message").waitFor({ state: "visible" });
    assert.match(await page.textContent("#message"), /factor/);
    assert.equal(await page.textContent("#status-connection"), "connected");
    await page.fill("#factor", "1");
    await page.locator("#factor").blur();
    await converged(page);
  });

  it("follows the size of the window", async () => {
    await page.setViewportSize({ width: 800, height: 400 });
    await page.waitForFunction(() => radiata.lastFrame().width === 800);
    await page.setViewportSize({ width: 960, height: 520 });
    await page.waitForFunction(() => radiata.lastFrame().width === 960);
    await converged(page);
  });

  it("sends the newest camera, not all of them, and ends at the last", async () => {
    let updates = 0;
    const count = (request) => (updates += request.url().endsWith("/Update") ? 1 : 0);
    page.on("request", count);
    await page.evaluate(() => {
      const press = () => dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight" }));
      for (let i = 0; i < 500; ++i) press();
    });
    await converged(page);
    page.off("request", count);
    assert.ok(updates < 40, `${updates} updates for 500 moves`);
  });
});

describe("fingers", () => {
  it("one turns, two pan and pinch", async () => {
    const touch = await openPage(nginx.url, { touch: true });
    try {
      await converged(touch.page);
      const protocol = await touch.page.context().newCDPSession(touch.page);
      const fingers = (type, ...points) =>
        protocol.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
      const start = await camera(touch.page);
      await fingers("touchStart", [150, 150]);
      await fingers("touchMove", [220, 150]);
      await fingers("touchEnd");
      const turned = await camera(touch.page);
      assert.notDeepEqual(turned.eye_mm, start.eye_mm);
      assert.deepEqual(turned.target_mm, start.target_mm);
      await fingers("touchStart", [150, 150], [250, 150]);
      await fingers("touchMove", [100, 150], [300, 150]);
      await fingers("touchEnd");
      const pinched = await camera(touch.page);
      assert.ok(Math.abs(pinched.height_mm * 2 - turned.height_mm) < 1e-6, `${pinched.height_mm}, ${turned.height_mm}`);
      await converged(touch.page);
      assert.deepEqual(touch.problems, []);
    } finally {
      await touch.close();
    }
  });
});

describe("a server that goes away", () => {
  it("is told as reconnecting, with the reason, and the picture stays", async () => {
    await server.stop("SIGKILL");
    await page.waitForFunction(() => radiata.connection() === "reconnecting");
    await until("the status line", async () => (await page.textContent("#status-connection")) === "reconnecting");
    await until("the reason", async () => (await page.textContent("#message")) !== "");
    await keep(page);
    assert.ok(await page.evaluate(() => globalThis.kept.data.some((value, i) => i % 4 < 3 && value > 0)));
  });

  it("is found again by itself, with the camera that was moved meanwhile", async () => {
    await page.evaluate(() => dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowUp" })));
    const moved = await camera(page);
    server = await startStubServer(serverPort);
    await converged(page);
    assert.equal((await lastFrame(page)).connection, 2);
    assert.deepEqual(await camera(page), moved);
    assert.equal(await page.isVisible("#message"), false);
    await keep(page);
    const file = join(folder, "again.png");
    await native("render", moved, file);
    assert.equal((await compare(page, readFileSync(file), "image/png")).different, 0);
  });

  it("left nothing wrong in the page", () => assert.deepEqual(browser.problems, []));
});
