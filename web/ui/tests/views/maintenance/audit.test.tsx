import { render } from "preact";
import { act } from "preact/test-utils";
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { navigate } from "../../../src/router";
import { session } from "../../../src/session";
import type { AuditEntry, Role } from "../../../src/types";
import { AuditPart } from "../../../src/views/maintenance/audit";

const ENTRY: AuditEntry = {
  n: 12,
  at: "2026-11-27T08:00:00Z",
  who: "Ada",
  via: "user",
  role: "administrator",
  action: "user.role_changed",
  subject: "user 4",
  before: { role: "operator" },
  after: { role: "viewer" },
  hash: "0",
};
const BY_STATION: AuditEntry = {
  ...ENTRY,
  n: 11,
  who: null,
  via: "terminal",
  role: null,
  action: "user.removed",
  subject: "user 40",
  before: { role: "mes" },
  after: null,
};

let place: HTMLElement;
let next: number | null;
const asked = vi.fn();

const signedInAs = (role: Role) => {
  session.value = { name: "Ada", role, via: "user", signs_off_after_s: 3600, sign_out_at: null };
};
const settled = () => act(() => new Promise((done) => setTimeout(done)));
const draw = async () => {
  await act(() => render(<AuditPart />, place));
  await settled();
};
const cells = (n: number) =>
  [...[...place.querySelectorAll("tbody tr")][n]!.querySelectorAll("td")].map((one) => one.textContent);
const button = (name: string) =>
  [...place.querySelectorAll("button")].find((one) => one.textContent === name)!;
const press = async (name: string) => {
  await act(() => button(name).click());
  await settled();
};

beforeEach(() => {
  asked.mockReset();
  next = null;
  navigate("/maintenance?part=audit");
  vi.stubGlobal("fetch", (address: string) => {
    const items = address.endsWith("/users") ? [{ id: 4, name: "Carla" }] : [ENTRY, BY_STATION];
    if (!address.endsWith("/users")) asked(address);
    return Promise.resolve(new Response(JSON.stringify({ items, next })));
  });
  place = document.body.appendChild(document.createElement("div"));
});

afterEach(() => {
  render(null, place);
  place.remove();
  session.value = undefined;
});

it("is not asked for whom it is not meant for", async () => {
  signedInAs("engineer");
  await draw();
  expect(asked).not.toHaveBeenCalled();
  expect(place.textContent).toContain("Needs the role administrator. Your role is engineer.");
});

it("says who did what, in which role, and what it was before and after", async () => {
  signedInAs("administrator");
  await draw();
  expect(cells(0)[0]).toBe("12");
  expect(cells(0).slice(2)).toEqual([
    "Ada",
    "administrator",
    "role changed user.role_changed",
    "user 4 (Carla)",
    "role operator → role viewer",
  ]);
  expect(cells(1).slice(2)).toEqual([
    "(name erased)",
    "terminal",
    "user removed user.removed",
    "user 40",
    "role MES → –",
  ]);
  expect(place.textContent).toContain("2 entries on this page");
  expect(place.querySelector("a")!.getAttribute("href")).toBe("/api/v1/audit.csv");
});

it("goes on to older entries and back to the newest, and keeps what is looked for", async () => {
  signedInAs("administrator");
  next = 11;
  await draw();
  expect(asked).toHaveBeenLastCalledWith("/api/v1/audit?limit=200");
  expect(button("Newest").disabled).toBe(true);
  const looked = place.querySelector<HTMLInputElement>("#audit-filter")!;
  await act(() => {
    looked.value = "role viewer";
    looked.dispatchEvent(new Event("input", { bubbles: true }));
  });
  await settled();
  expect(asked).toHaveBeenLastCalledWith("/api/v1/audit?limit=200&contains=role+viewer");
  await press("Older");
  expect(asked).toHaveBeenLastCalledWith("/api/v1/audit?limit=200&cursor=11&contains=role+viewer");
  next = null;
  await press("Newest");
  expect(asked).toHaveBeenLastCalledWith("/api/v1/audit?limit=200&contains=role+viewer");
  expect(button("Older").disabled).toBe(true);
});
