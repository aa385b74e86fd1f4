import { beforeEach, expect, it, vi } from "vitest";

type Router = typeof import("../src/router");
let router: Router;

beforeEach(async () => {
  history.replaceState(null, "", "/history?verdict=pass");
  vi.resetModules();
  router = await import("../src/router");
});

it("starts at the address of the page", () => {
  expect(router.path.value).toBe("/history");
  expect(router.query.value.get("verdict")).toBe("pass");
});

it("changes the view and adds an entry to the browser's history", () => {
  const before = history.length;
  router.navigate("/result/7");
  expect(location.pathname).toBe("/result/7");
  expect(router.path.value).toBe("/result/7");
  expect([...router.query.value]).toEqual([]);
  expect(history.length).toBe(before + 1);
});

it("changes a filter without adding an entry", () => {
  const before = history.length;
  router.navigate("/history?state=failed", { replace: true });
  expect(location.search).toBe("?state=failed");
  expect(router.query.value.get("state")).toBe("failed");
  expect(history.length).toBe(before);
});

it("follows the browser's back button", () => {
  history.replaceState(null, "", "/diagnosis/3?by=travel");
  dispatchEvent(new PopStateEvent("popstate"));
  expect(router.path.value).toBe("/diagnosis/3");
  expect(router.query.value.get("by")).toBe("travel");
});
