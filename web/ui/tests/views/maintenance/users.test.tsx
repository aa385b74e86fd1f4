import { render } from "preact";
import { act } from "preact/test-utils";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { confirm, disarm } from "../../../src/armed";
import { station } from "../../../src/live";
import type { User } from "../../../src/types";
import { Users } from "../../../src/views/maintenance/users";
import { stationNow } from "../../samples";

const BO: User = {
  id: 4,
  name: "Bo",
  role: "operator",
  has_badge: true,
  by_provider: false,
  disabled: false,
  created_at: "2026-11-27T08:00:00Z",
};
const CLEO: User = { ...BO, id: 5, name: "Cleo", role: "engineer", has_badge: false, disabled: true };
const EVE: User = { ...BO, id: 6, name: "Eve", has_badge: false, by_provider: true };

let place: HTMLElement;
let known: User[];
let refusal: { detail: string } | null;
const sent = vi.fn();

const settled = () => act(() => new Promise((done) => setTimeout(done)));
const field = (id: string) => place.querySelector<HTMLInputElement>(`#${id}`)!;
const type = (id: string, text: string) =>
  act(() => {
    field(id).value = text;
    field(id).dispatchEvent(new Event("input", { bubbles: true }));
  });
const choose = async (id: string, option: string) => {
  await act(() => {
    const select = place.querySelector<HTMLSelectElement>(`#${id}`)!;
    select.value = option;
    select.dispatchEvent(new Event("change", { bubbles: true }));
  });
  await settled();
};
const button = (name: string) =>
  [...place.querySelectorAll("button")].find(
    (one) => one.getAttribute("aria-label") === name || one.textContent === name,
  )!;
const press = async (name: string) => {
  await act(() => button(name).click());
  await settled();
};
const confirmed = async () => {
  await act(() => {
    confirm();
  });
  await settled();
};
const row = (name: string) =>
  [...place.querySelectorAll("tbody tr")].find((one) => one.querySelector("th")!.textContent === name)!;

beforeEach(async () => {
  disarm();
  sent.mockReset();
  refusal = null;
  known = [BO, CLEO, EVE];
  station.value = stationNow({});
  vi.stubGlobal("fetch", (address: string, options: RequestInit) => {
    if (options.method === "GET") return Promise.resolve(new Response(JSON.stringify({ items: known })));
    sent(options.method, address, options.body ? JSON.parse(options.body as string) : undefined);
    const status = refusal ? 409 : 200;
    return Promise.resolve(new Response(JSON.stringify(refusal ?? BO), { status }));
  });
  place = document.body.appendChild(document.createElement("div"));
  await act(() => render(<Users />, place));
  await settled();
});

afterEach(() => {
  render(null, place);
  place.remove();
});

describe("the users", () => {
  it("are listed with role, badge and whether they may sign in", () => {
    expect(row("Bo").textContent).toContain("yes");
    expect(row("Cleo").textContent).toContain("◆ disabled");
    expect(row("Eve").textContent).toContain("signs in with the plant's provider");
    expect(place.querySelector<HTMLSelectElement>("#role-5")!.value).toBe("engineer");
  });

  it("get another role at once, and a refusal is said", async () => {
    await choose("role-4", "viewer");
    expect(sent).toHaveBeenLastCalledWith("PATCH", "/api/v1/users/4", { role: "viewer" });
    refusal = { detail: "Bo is the last administrator who can sign in; make another one first." };
    await choose("role-4", "mes");
    expect(place.querySelector(".part > .trouble")!.textContent).toContain("last administrator");
    expect(field("role-4").value).toBe("operator");
  });

  it("are disabled only after a confirmation, and enabled without", async () => {
    await press("Disable Bo");
    expect(sent).not.toHaveBeenCalled();
    await confirmed();
    expect(sent).toHaveBeenLastCalledWith("PATCH", "/api/v1/users/4", { disabled: true });
    await press("Enable Cleo");
    expect(sent).toHaveBeenLastCalledWith("PATCH", "/api/v1/users/5", { disabled: false });
  });

  it("are removed only while disabled, and after a confirmation", async () => {
    expect([...place.querySelectorAll("button")].map((one) => one.textContent)).not.toContain("Remove Bo");
    await press("Remove Cleo");
    expect(sent).not.toHaveBeenCalled();
    await confirmed();
    expect(sent).toHaveBeenLastCalledWith("DELETE", "/api/v1/users/5", undefined);
  });
});

describe("a new user", () => {
  it("needs a name, and a password or a badge with its PIN", async () => {
    expect(button("Add the user").disabled).toBe(true);
    await type("user-name", " Dora ");
    expect(button("Add the user").disabled).toBe(true);
    await type("user-badge", "BADGE:7");
    expect(button("Add the user").disabled).toBe(true);
    await type("user-pin", "1234");
    expect(button("Add the user").disabled).toBe(false);
    await type("user-badge", "");
    await type("user-pin", "");
    await type("user-password", "correct horse");
    expect(button("Add the user").disabled).toBe(false);
  });

  it("is sent as it was typed, and nothing of it stays in the fields", async () => {
    await type("user-name", " Dora ");
    await type("user-badge", " BADGE:7 ");
    await type("user-pin", "1234");
    await choose("user-role", "engineer");
    await press("Add the user");
    expect(sent).toHaveBeenCalledWith("POST", "/api/v1/users", {
      name: "Dora",
      role: "engineer",
      password: null,
      badge: "BADGE:7",
      pin: "1234",
    });
    for (const id of ["user-name", "user-password", "user-badge", "user-pin"]) {
      expect(field(id).value).toBe("");
    }
  });

  it("that is refused can be corrected", async () => {
    refusal = { detail: "There is a user Bo already; choose another name." };
    await type("user-name", "Bo");
    await type("user-password", "correct horse");
    await press("Add the user");
    expect(place.textContent).toContain("▲ There is a user Bo already");
    expect(field("user-name").value).toBe("Bo");
  });
});

describe("the sign-in of a user", () => {
  it("is not offered for who signs in with the provider", () => {
    const offered = [...place.querySelectorAll("#sign-in-user option")].map((one) => one.textContent);
    expect(offered).toEqual(["Bo", "Cleo"]);
  });

  it("changes only where something was typed", async () => {
    expect(button("Save the new sign-in").disabled).toBe(true);
    await type("sign-in-pin", "5678");
    await press("Save the new sign-in");
    expect(sent).toHaveBeenCalledWith("PATCH", "/api/v1/users/4", { pin: "5678" });
    expect(field("sign-in-pin").value).toBe("");
    expect(place.textContent).toContain("The new sign-in of Bo is saved.");
  });

  it("is that of the one who is chosen, with nothing left of another one", async () => {
    await type("sign-in-password", "meant for Bo");
    await choose("sign-in-user", "5");
    expect(field("sign-in-password").value).toBe("");
    await type("sign-in-badge", " BADGE:8 ");
    await type("sign-in-pin", "5678");
    await press("Save the new sign-in");
    expect(sent).toHaveBeenCalledWith("PATCH", "/api/v1/users/5", { badge: "BADGE:8", pin: "5678" });
  });

  it("loses its badge after a confirmation, where there is one", async () => {
    await choose("sign-in-user", "5");
    expect(button("Remove the badge").disabled).toBe(true);
    await choose("sign-in-user", "4");
    await press("Remove the badge");
    expect(sent).not.toHaveBeenCalled();
    await confirmed();
    expect(sent).toHaveBeenCalledWith("PATCH", "/api/v1/users/4", { remove_badge: true });
    expect(place.textContent).toContain("Bo has no badge any more.");
  });
});

it("says that there are no users, and offers no sign-in of one", async () => {
  render(null, place);
  known = [];
  await act(() => render(<Users />, place));
  await settled();
  expect(place.textContent).toContain("There are no users.");
  expect(place.querySelector("#sign-in-user")).toBeNull();
});
