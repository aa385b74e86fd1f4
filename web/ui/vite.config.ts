import { defineConfig } from "vite";

export default defineConfig({
  build: {
    // a browser that a plant keeps for years; tsconfig.json has the same year in `lib`
    target: ["firefox115", "chrome115"],
    outDir: "../static",
    emptyOutDir: true,
    modulePreload: { polyfill: false },
    // the content security policy allows no data: addresses
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 700,
  },
  server: {
    // the message file that the page shares with the service
    fs: { allow: ["../.."] },
    proxy: { "/api": { target: "http://127.0.0.1:8000", ws: true } },
  },
});
