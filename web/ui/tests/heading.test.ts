import { afterEach, beforeEach, expect, it } from "vitest";
import { followHeading } from "../src/heading";
import { navigate } from "../src/router";

let main: HTMLElement;
let stop: () => void;
const settled = () => new Promise((later) => setTimeout(later, 5));
const show = async (html: string) => {
  main.innerHTML = html;
  await settled();
};

beforeEach(() => {
  main = document.body.appendChild(document.createElement("main"));
  stop = followHeading(main);
});
afterEach(() => {
  stop();
  main.remove();
});

it("follows the heading of the view with title and focus, also when it comes late", async () => {
  await show("<h1>Station</h1><input>");
  expect(document.title).toBe("Station – Calibration station");
  expect(document.activeElement).toBe(document.body);
  navigate("/result/3");
  await show("<h1>Result</h1>");
  expect(document.activeElement?.textContent).toBe("Result");
  await show("<h1>Result of run 3</h1>");
  expect(document.activeElement?.textContent).toBe("Result of run 3");
  expect(document.title).toContain("Result of run 3");
});

it("leaves the focus alone where the view has set it, and after a key", async () => {
  navigate("/history");
  await show("<h1>History</h1><input>");
  main.querySelector("input")!.focus();
  await show("<h1>History</h1>");
  document.dispatchEvent(new KeyboardEvent("keydown", { key: "Tab" }));
  await show("<h1>History</h1>");
  expect(document.activeElement).toBe(document.body);
});
