import { expect, it } from "vitest";
import { address, newest, older, toApi, withFilter } from "../../../src/views/history/address";

const query = (text: string) => new URLSearchParams(text);

it("the address has the filters, and no question mark without any", () => {
  expect(address(query("state=failed"))).toBe("/history?state=failed");
  expect(address(query(""))).toBe("/history");
});

it("a filter is set or cleared, and either leads to the newest page", () => {
  const before = query("state=failed&cursor=40");
  expect(withFilter(before, "verdict", "pass").toString()).toBe("state=failed&verdict=pass");
  expect(withFilter(before, "state", "").toString()).toBe("");
  expect(before.get("cursor")).toBe("40");
});

it("pages keep the filters", () => {
  expect(older(query("state=failed"), 17).toString()).toBe("state=failed&cursor=17");
  expect(newest(query("state=failed&cursor=17")).toString()).toBe("state=failed");
});

it("days are the operator's, the last one included", () => {
  const asked = toApi(query("since=2024-03-05&until=2024-02-29&robot_serial=A"));
  expect(asked.get("since")).toBe(new Date(2024, 2, 5).toISOString());
  expect(asked.get("until")).toBe(new Date(2024, 2, 1).toISOString());
  expect(asked.get("robot_serial")).toBe("A");
  expect(asked.get("limit")).toBe("20");
});
