import { render } from "preact";
import { act } from "preact/test-utils";
import { expect, it } from "vitest";
import { Fold } from "../../src/parts/fold";
import { navigate, query } from "../../src/router";

it("keeps what is open in the address, beside what stands there already", async () => {
  navigate("/result/1?by=time");
  const place = document.body.appendChild(document.createElement("div"));
  const show = () =>
    act(() =>
      render(
        <>
          <Fold name="one" title="One">
            first
          </Fold>
          <Fold name="two" title="Two">
            second
          </Fold>
        </>,
        place,
      ),
    );
  await show();
  expect(place.textContent).not.toContain("first");
  const folds = place.querySelectorAll("details");
  const toggle = (fold: HTMLDetailsElement, open: boolean) =>
    act(() => {
      fold.open = open;
      fold.dispatchEvent(new Event("toggle"));
    });
  await toggle(folds[0]!, true);
  await toggle(folds[1]!, true);
  expect(query.value.get("open")).toBe("one.two");
  expect(query.value.get("by")).toBe("time");
  expect(place.textContent).toContain("firstTwosecond");
  await toggle(folds[0]!, false);
  expect(query.value.get("open")).toBe("two");
  await toggle(folds[1]!, false);
  expect(query.value.has("open")).toBe(false);
  render(null, place);
});
