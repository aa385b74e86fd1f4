import { render } from "preact";
import { beforeEach, expect, it, vi } from "vitest";
import { station } from "../../../src/live";
import { Who } from "../../../src/parts/who";
import { session, watchSession } from "../../../src/session";
import { SignInView } from "../../../src/views/sign-in/sign-in";
import { stationNow } from "../../samples";

const ADA = { name: "Ada", role: "operator", via: "user", signs_off_after_s: 3600 };
const asked = vi.fn();
let answer: [unknown, number];

beforeEach(() => {
  asked.mockReset();
  session.value = undefined;
  station.value = null;
  vi.stubGlobal("fetch", (address: string, options: RequestInit) => {
    asked(options.method, address, options.body);
    const [body, status] = answer;
    return Promise.resolve(new Response(body === null ? null : JSON.stringify(body), { status }));
  });
});

const drawn = (part: preact.ComponentChild) => {
  const place = document.createElement("div");
  document.body.append(place);
  render(part, place);
  return place;
};
const type = (place: Element, id: string, text: string) => {
  const field = place.querySelector<HTMLInputElement>(`#${id}`)!;
  field.value = text;
  field.dispatchEvent(new Event("input", { bubbles: true }));
};
const submit = (place: Element) =>
  place.querySelector("form")!.dispatchEvent(new Event("submit", { bubbles: true, cancelable: true }));

it("signs in, and says why not", async () => {
  const place = drawn(<SignInView />);
  type(place, "name", "ada");
  type(place, "password", "wrong password");
  answer = [{ detail: "Name or password is wrong." }, 401];
  submit(place);
  await vi.waitFor(() => expect(place.querySelector("[role=alert]")!.textContent).toContain("wrong"));
  expect(session.value).toBeUndefined();
  type(place, "password", "correct horse");
  answer = [ADA, 201];
  submit(place);
  await vi.waitFor(() => expect(session.value?.name).toBe("Ada"));
  const body = JSON.stringify({ name: "ada", password: "correct horse" });
  expect(asked).toHaveBeenLastCalledWith("POST", "/api/v1/session", body);
});

it("shows who is signed in, and signs out", async () => {
  session.value = ADA as typeof session.value;
  const place = drawn(<Who />);
  expect(place.textContent).toContain("Ada");
  answer = [null, 204];
  place.querySelector("button")!.click();
  await vi.waitFor(() => expect(session.value).toBeNull());
});

it("says that an open station asks nobody", () => {
  const now = stationNow({});
  station.value = { ...now, station: { ...now.station, open: true } };
  expect(drawn(<Who />).textContent).toContain("OPEN");
});

it("notices that nobody is signed in", async () => {
  vi.useFakeTimers();
  answer = [{ detail: "Sign in." }, 401];
  watchSession();
  vi.useRealTimers();
  await vi.waitFor(() => expect(session.value).toBeNull());
});

it("leads to the plant's provider, and says why that has signed nobody in", async () => {
  answer = [{ openid: "Plant login" }, 200];
  const place = drawn(<SignInView />);
  await vi.waitFor(() => expect(place.querySelector("a")!.textContent).toContain("Plant login"));
  expect(place.querySelector("a")!.getAttribute("href")).toBe("/api/v1/session/openid");
  expect(place.querySelector("[role=alert]")!.textContent).toBe("");
  for (const [why, said] of [
    ["no_role", "none of your groups"],
    ["what a later version says", "cannot be used"],
  ]) {
    location.hash = `#refused=${why}`;
    expect(drawn(<SignInView />).querySelector("[role=alert]")!.textContent).toContain(said);
  }
  location.hash = "";
});

it("signs out at the provider as well", async () => {
  const gone = vi.spyOn(location, "assign").mockImplementation(() => {});
  session.value = { ...ADA, sign_out_at: "/api/v1/session/openid/end" } as typeof session.value;
  const place = drawn(<Who />);
  answer = [null, 204];
  place.querySelector("button")!.click();
  await vi.waitFor(() => expect(gone).toHaveBeenCalledWith("/api/v1/session/openid/end"));
  expect(session.value).toBeNull();
});
