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
    rolldownOptions: {
      output: {
        codeSplitting: {
          groups: [
            // does not wait for the texts of the page
            { name: "feed", test: /node_modules[\\/]@?preact|src[\\/](feed|live)\.ts/ },
            // what every view needs is one file
            {
              name: "frame",
              test: /src[\\/](?!feed|live|main)\w+\.tsx?$|src[\\/]messages[\\/](index|language|said|phrases)\.ts/,
            },
          ],
        },
      },
    },
  },
  server: {
    // the message file that the page shares with the service
    fs: { allow: ["../.."] },
    proxy: { "/api": { target: "http://127.0.0.1:8000", ws: true } },
  },
});
