import { defineConfig } from "vitest/config";

export default defineConfig({
  // as tsconfig.json has it
  oxc: { jsx: { runtime: "automatic", importSource: "preact" } },
  // the message file and the catalogue of effects of the service
  server: { fs: { allow: ["../.."] } },
  test: {
    environment: "happy-dom",
    include: ["tests/**/*.test.{ts,tsx}"],
    restoreMocks: true,
    unstubGlobals: true,
    coverage: {
      provider: "v8",
      include: ["src/**/*.{ts,tsx}"],
      exclude: ["src/api-types.ts", "src/types.ts", "src/main.tsx"],
      reporter: ["text"],
      reportsDirectory: "node_modules/.coverage",
    },
  },
});
