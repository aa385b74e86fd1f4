import { expect, it } from "vitest";
import { taughtOf, translatedCsv } from "../../../src/views/result/taught";

it("reads positions with or without column names, however they are separated", () => {
  const positions = [
    { position: "pick", theta1_deg: 10.5, theta2_deg: 170 },
    { position: "place", theta1_deg: -3, theta2_deg: 181.25 },
  ];
  for (const text of [
    "position,theta1_deg,theta2_deg\npick,10.5,170\nplace,-3,181.25\n",
    "pick 10.5 170\n\nplace;-3;181.25",
  ]) {
    expect(taughtOf(text)).toEqual({ positions, wrong: null });
  }
});

it.each(["pick,10", "pick,a,1", "pick,1,2,3", "pick,,1"])("names the line of %j", (line) =>
  expect(taughtOf(`a,1,2\n${line}`)).toEqual({ positions: [], wrong: 2 }),
);

it("writes the columns of the command line", () =>
  expect(
    translatedCsv([{ position: "a", theta1_deg: 1, theta2_deg: 2, u95_mm: null, within_limits: false }]),
  ).toBe("position,theta1_deg,theta2_deg,u95_mm,within_limits\na,1,2,,false\n"));
