import { beforeEach, describe, expect, it, vi } from "vitest";
import * as api from "../src/api";
import * as live from "../src/live";
import { t } from "../src/messages";

const fetched = vi.fn<typeof fetch>();
const answer = (status: number, body: unknown) =>
  fetched.mockResolvedValueOnce(new Response(JSON.stringify(body), { status }));
const body = { robot_serial: "FB-1", plan: "paper" as const, operator: "ada" };

beforeEach(() => {
  fetched.mockReset();
  vi.stubGlobal("fetch", fetched);
});

describe("a refusal", () => {
  it("carries the service's words and the field that they are about", async () => {
    answer(422, { title: "Invalid", detail: "The serial has a space.", field: "robot_serial" });
    const refused = await api.start(body, "k").catch((error: unknown) => error);
    expect(refused).toBeInstanceOf(api.Refused);
    expect(refused).toMatchObject({ message: "The serial has a space.", field: "robot_serial" });
  });

  it("is made of its code where there is one", async () => {
    const why = { code: "depends_on_approach", params: { causes: "backlash of joint 2" } };
    const said = { code: "target_refused", params: { number: 3, column: "approach2", why } };
    answer(422, { detail: "English", field: "targets.3.approach2", said });
    await expect(api.solve(1, [])).rejects.toMatchObject({
      message: "Target 3, approach2: is missing or 0, but backlash of joint 2 depends on it; give -1 or 1.",
    });
  });

  it("without words names the status", async () => {
    fetched.mockResolvedValueOnce(new Response("<html>", { status: 502 }));
    await expect(api.calibration(1)).rejects.toMatchObject({ message: t.refusals.status(502), field: null });
  });

  it("is also that nothing answers", async () => {
    fetched.mockRejectedValueOnce(new TypeError("Failed to fetch"));
    await expect(api.abort(1)).rejects.toMatchObject({ name: "Error", message: t.refusals.noAnswer });
  });
});

it("answers what the service answers", async () => {
  answer(200, { id: 7 });
  expect(await api.calibration(7)).toEqual({ id: 7 });
  expect(fetched).toHaveBeenCalledWith("/api/v1/calibrations/7", expect.objectContaining({ method: "GET" }));
});

it("says until when a command is worth something, by the clock of the station", async () => {
  vi.spyOn(live, "stationTime").mockReturnValue(1_700_000_000_000.4);
  for (const command of [
    () => api.start(body, "k"),
    () => api.apply(3, "ada", "k"),
    () => api.rollBack(3, "ada"),
    () => api.retract("ada", "k"),
    () => api.answer(3, "mount", 1, "ada"),
    () => api.separate(3, "ada", "k"),
    () => api.resume(3, "ada", "k"),
  ]) {
    answer(200, {});
    await command();
    expect(fetched.mock.lastCall?.[1]?.headers).toMatchObject({ "X-Not-After": "1700000008000" });
  }
  answer(200, {});
  await api.stop();
  expect(fetched.mock.lastCall?.[1]?.headers).not.toHaveProperty("X-Not-After");
});

it("starts with the key of the confirmed start", async () => {
  answer(202, { id: 1 });
  await api.start(body, "key-1");
  const [path, request] = fetched.mock.calls[0]!;
  expect(path).toBe("/api/v1/calibrations");
  expect(request).toMatchObject({ method: "POST", headers: { "Idempotency-Key": "key-1" } });
  expect(JSON.parse(request?.body as string)).toEqual(body);
});

it.each([
  ["apply", () => api.apply(3, "ada", "k"), "POST", "/calibrations/3/apply"],
  ["rollBack", () => api.rollBack(3, "ada"), "POST", "/calibrations/3/rollback"],
  ["separate", () => api.separate(3, "ada", "k"), "POST", "/calibrations/3/separate"],
  ["forget", () => api.forget("A/1", "ada"), "DELETE", "/robots/A%2F1/memory"],
  ["robot", () => api.robot("A/1"), "GET", "/robots/A%2F1"],
  ["stop", () => api.stop(), "POST", "/stop"],
  ["residuals", () => api.residuals(3), "GET", "/calibrations/3/residuals"],
  ["separating", () => api.separating(3), "GET", "/calibrations/3/separating"],
  ["diagnosis", () => api.diagnosis(3), "GET", "/calibrations/3/diagnosis"],
  [
    "calibrations",
    () => api.calibrations(new URLSearchParams({ state: "failed" })),
    "GET",
    "/calibrations?state=failed",
  ],
] as const)("%s asks the path of the contract", async (_, ask, method, path) => {
  answer(200, {});
  await ask();
  expect(fetched).toHaveBeenCalledWith(`/api/v1${path}`, expect.objectContaining({ method }));
});

it("names who deletes, in letters that a header may carry", async () => {
  answer(200, null);
  await api.forget("FB-1", "Zoë");
  expect(fetched.mock.calls[0]?.[1]?.headers).toEqual({ "X-Operator": "Zo%C3%AB" });
});

it("makes a new key of 128 bits each time", () => {
  const keys = new Set(Array.from({ length: 50 }, api.newKey));
  expect(keys.size).toBe(50);
  for (const key of keys) expect(key).toMatch(/^[0-9a-f]{32}$/);
});
