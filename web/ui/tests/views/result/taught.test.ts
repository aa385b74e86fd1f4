import { expect, it } from "vitest";
import { isFile, taughtOf, translatedCsv } from "../../../src/views/result/taught";

it("reads positions with or without column names, however they are separated", () => {
  const positions = [
    { position: "pick", theta1_deg: 10.5, theta2_deg: 170 },
    { position: "place", theta1_deg: -3, theta2_deg: 181.25 },
  ];
  for (const text of [
    "position,theta1_deg,theta2_deg\npick,10.5,170\nplace,-3,181.25\n",
    "pick 10.5 170\n\nplace;-3;181.25",
    "pick;10,5;170,0\nplace -3 181,25",
    "pick, 10.5, 170\nplace, -3, 181.25",
  ]) {
    expect(taughtOf(text)).toEqual({ positions, wrong: null });
  }
});

it.each(["pick,10", "pick,a,1", "pick,1,2,3", "pick,,1"])("names the line of %j", (line) =>
  expect(taughtOf(`a,1,2\n${line}`)).toEqual({ positions: [], wrong: 2 }),
);

it.each([
  "theta2_deg;position;theta1_deg\n170;pick;10",
  "DECL E6AXIS P={A1 1.0,A2 2.0}",
  "CONST jointtarget p := [[1,2,0,0,0,0],[9E9]];",
])("leaves %j to the station", (text) => expect(isFile(text)).toBe(true));

it("reads typed lines itself", () => expect(isFile("A1 1.0 2.0\npick,10,170")).toBe(false));

it("writes the columns of the command line", () =>
  expect(
    translatedCsv([{ position: "a", theta1_deg: 1, theta2_deg: 2, u95_mm: null, within_limits: false }]),
  ).toBe("position,theta1_deg,theta2_deg,u95_mm,within_limits\na,1,2,,false\n"));
