import { beforeAll, beforeEach, expect, it, vi } from "vitest";
import * as api from "../src/api";

const MINUTE_MS = 60_000;
const fetched = vi.fn<typeof fetch>();

const headers = async () => {
  fetched.mockResolvedValueOnce(new Response("{}"));
  await api.session();
  return fetched.mock.lastCall?.[1]?.headers;
};

beforeAll(() => {
  vi.useFakeTimers();
});
beforeEach(() => {
  vi.stubGlobal("fetch", fetched);
});

it.each(["pointerdown", "keydown", "wheel"])("somebody is there for a minute after a %s", async (sign) => {
  vi.advanceTimersByTime(3 * MINUTE_MS);
  expect(await headers()).toEqual({ "X-Unattended": "1" });
  document.body.dispatchEvent(new Event(sign, { bubbles: true }));
  vi.advanceTimersByTime(MINUTE_MS);
  expect(await headers()).toEqual({});
  vi.advanceTimersByTime(1);
  expect(await headers()).toEqual({ "X-Unattended": "1" });
});
