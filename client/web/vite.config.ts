// The build: one page, no inline scripts or styles (the content security policy of deploy/nginx forbids them).
import { defineConfig } from "vite";

export default defineConfig({
  build: {
    target: "es2022",
    outDir: "dist",
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
  },
});
