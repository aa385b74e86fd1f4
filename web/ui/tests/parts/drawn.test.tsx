import { render } from "preact";
import { act } from "preact/test-utils";
import { expect, it } from "vitest";
import { t } from "../../src/messages";
import { Drawn } from "../../src/parts/drawn";

type Draw = (place: HTMLElement) => () => void;

/** Drawings that come when the test lets them; each writes its name. */
function stage() {
  const loads = new Map<string, { come: () => void; fail: () => void }>();
  const place = document.createElement("div");
  const show = (name: string) => {
    const load = () =>
      new Promise<Draw>((resolve, reject) => {
        const draw: Draw = (chart) => {
          chart.textContent += name;
          return () => {
            chart.textContent = "";
          };
        };
        loads.set(name, { come: () => resolve(draw), fail: () => reject(new Error("gone")) });
      });
    return act(() => render(<Drawn label="Chart" on={name} load={load} />, place));
  };
  const settle = (name: string, how: "come" | "fail") => act(async () => loads.get(name)?.[how]());
  const chart = () => place.querySelector(".chart")?.textContent;
  const trouble = () => place.querySelector<HTMLElement>("[role=status]")!;
  return { place, show, settle, chart, trouble };
}

it("draws when the drawing has come, and takes away what was drawn before", async () => {
  const { show, settle, chart } = stage();
  await show("a");
  expect(chart()).toBe("");
  await settle("a", "come");
  expect(chart()).toBe("a");
  await show("b");
  await settle("b", "come");
  expect(chart()).toBe("b");
});

it("draws only the latest of those asked for while it loads", async () => {
  const { show, settle, chart } = stage();
  await show("a");
  await show("b");
  await settle("b", "come");
  await settle("a", "come");
  expect(chart()).toBe("b");
});

it("reports a drawing that does not come, until another does", async () => {
  const { show, settle, trouble } = stage();
  await show("a");
  expect(trouble().hidden).toBe(true);
  await settle("a", "fail");
  expect(trouble().hidden).toBe(false);
  expect(trouble().textContent).toBe(t.shared.chartMissing);
  await show("b");
  await settle("b", "come");
  expect(trouble().hidden).toBe(true);
});

it("leaves nothing drawn when it goes", async () => {
  const { place, show, settle } = stage();
  await show("a");
  await settle("a", "come");
  const box = place.querySelector(".chart");
  await act(() => render(null, place));
  expect(box?.textContent).toBe("");
});
