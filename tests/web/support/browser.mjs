// Chromium with the page in it, and what tests ask the page.
import { createRequire } from "node:module";
import { join } from "node:path";
import { root, scratchFolder } from "./processes.mjs";

const { chromium } = createRequire(join(root, "client/web/package.json"))("playwright-core");

const kFlags = [
  "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage", "--force-color-profile=srgb",
];

/** \return {page, close, problems}: problems are what the page complained about (errors, violated policies). */
export async function openPage(url, { width = 960, height = 520, touch = false } = {}) {
  const context = await chromium.launchPersistentContext(scratchFolder(), {
    executablePath: process.env.RADIATA_CHROMIUM ?? "/usr/bin/chromium",
    headless: true,
    args: kFlags,
    viewport: { width, height },
    hasTouch: touch,
  });
  const page = context.pages()[0] ?? (await context.newPage());
  const problems = [];
  page.on("pageerror", (error) => problems.push(String(error)));
  page.on("console", (message) => {
    // Chromium writes failed requests here too; those belong to tests that stop the server.
    if (message.type() === "error" && !message.text().startsWith("Failed to load resource")) problems.push(message.text());
  });
  await page.goto(url);
  return { page, problems, close: () => context.close() };
}

/** Waits until the page shows the finished picture of the camera it asked for last. */
export function converged(page, timeout = 60_000) {
  return page.waitForFunction(
    () => {
      const frame = globalThis.radiata?.lastFrame();
      return (
        frame?.state === "converged" &&
        radiata.connection() === "connected" &&
        JSON.stringify(radiata.camera()) === JSON.stringify(radiata.shownCamera())
      );
    },
    null,
    { timeout, polling: 50 },
  );
}

export const camera = (page) => page.evaluate(() => radiata.camera());
export const lastFrame = (page) => page.evaluate(() => radiata.lastFrame());
export const slicePosition = (page) =>
  page.evaluate(() => {
    const p = radiata.request().scene.layers[0].glyphs.selection.slice.positionMm;
    return [p.x ?? 0, p.y ?? 0, p.z ?? 0];  // zeros are left out of the JSON
  });

/** The options that ask `radiata` for the slice that the page shows, but for the camera. */
export async function nativeOptions(page) {
  const { width, height } = await lastFrame(page);
  const scene = await page.evaluate(() => radiata.request().scene);
  const glyphs = scene.layers[0].glyphs;
  const word = (value, prefix) => value.slice(prefix.length).toLowerCase().replaceAll("_", "-");
  return [
    "--dataset", glyphs.datasetId,
    "--size", `${width}x${height}`,
    "--plane", word(glyphs.selection.slice.plane, "PLANE_"),
    "--position", ...(await slicePosition(page)).map(String),
    "--scale", word(glyphs.scale.mode, "MODE_"),
    ...(glyphs.lmax === undefined ? [] : ["--lmax", String(glyphs.lmax)]),  // all bands, unless the page says how many
    "--lobes", word(glyphs.negativeLobes, "NEGATIVE_LOBES_"),
    "--convention", word(scene.annotations.convention, "CONVENTION_"),
  ];
}

/** Keeps the pixels that the canvas shows now, as window.kept, for `compare`. */
export const keep = (page) =>
  page.evaluate(() => {
    const canvas = document.getElementById("picture");
    globalThis.kept = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  });

/** Compares the kept pixels with an encoded picture. Pixels inside `without` (fractions of the picture) do not count: the marks that
 *  say how far a picture is.
 *  \return {width, height, different: pixels that differ, worst: largest difference of a channel, psnr: dB over the channels} */
export function compare(page, bytes, type, without = []) {
  return page.evaluate(
    async ({ base64, type, without }) => {
      const data = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
      const bitmap = await createImageBitmap(new Blob([data], { type }), { colorSpaceConversion: "none", premultiplyAlpha: "none" });
      const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d", { alpha: false });
      context.drawImage(bitmap, 0, 0);
      const expected = context.getImageData(0, 0, bitmap.width, bitmap.height);
      const kept = globalThis.kept;
      const { width, height } = expected;
      if (kept.width !== width || kept.height !== height) {
        throw new Error(`the page shows ${kept.width}x${kept.height}, the picture is ${width}x${height}`);
      }
      let different = 0, worst = 0, squares = 0, count = 0;
      for (let y = 0; y < height; ++y) {
        for (let x = 0; x < width; ++x) {
          if (without.some((box) => x >= box[0] * width && x < box[2] * width && y >= box[1] * height && y < box[3] * height)) continue;
          let largest = 0;
          for (let channel = 0; channel < 3; ++channel) {
            const at = 4 * (y * width + x) + channel;
            const difference = Math.abs(kept.data[at] - expected.data[at]);
            largest = Math.max(largest, difference);
            squares += difference * difference;
          }
          worst = Math.max(worst, largest);
          different += largest > 0 ? 1 : 0;
          count += 3;
        }
      }
      return { width, height, different, worst, psnr: squares === 0 ? Infinity : 10 * Math.log10((255 * 255 * count) / squares) };
    },
    { base64: bytes.toString("base64"), type, without },
  );
}
