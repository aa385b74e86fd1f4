import { describe, expect, it } from "vitest";
import {
  address,
  comparing,
  newest,
  older,
  toApi,
  toWholeList,
  withFilter,
} from "../../../src/views/history/address";

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

describe("what only the page knows", () => {
  const filters = new URLSearchParams("search=fb&order=oldest&cursor=9&show=process&a=1&b=2");

  it("is not asked of the service", () => {
    expect(toApi(filters).toString()).toBe("search=fb&order=oldest&cursor=9&limit=20");
    expect(toWholeList(filters).toString()).toBe("search=fb");
    expect(toWholeList(filters, "order").toString()).toBe("search=fb&order=oldest");
  });

  it("keeps the two runs that were chosen last", () => {
    const chosen = [5, 6, 7, 6].reduce(comparing, new URLSearchParams());
    expect([chosen.get("a"), chosen.get("b")]).toEqual(["7", "6"]);
    expect(comparing(new URLSearchParams(), 5).toString()).toBe("a=5");
  });

  it("gives up the one robot of a link for what is typed", () => {
    expect(withFilter(new URLSearchParams("robot_serial=FB-1"), "search", "fb").toString()).toBe("search=fb");
  });
});
