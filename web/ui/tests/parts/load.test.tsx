import { render } from "preact";
import { act } from "preact/test-utils";
import { expect, it } from "vitest";
import { Refused } from "../../src/api";
import { station } from "../../src/live";
import { useLoaded } from "../../src/parts/load";
import { stationNow, stopClock } from "../samples";

/** Answers that come when the test lets them. */
function stage() {
  const asked: { key: string; resolve: (text: string) => void; reject: (error: Error) => void }[] = [];
  function Shown({ name }: { name: string }) {
    const ask = () =>
      new Promise<string>((resolve, reject) => {
        asked.push({ key: name, resolve, reject });
      });
    const { value, trouble } = useLoaded(name, ask).value;
    return <p>{trouble ?? value ?? "nothing"}</p>;
  }
  const place = document.createElement("div");
  const show = (name: string) => act(() => render(<Shown name={name} />, place));
  return { asked, show, text: () => place.textContent };
}

it("keeps the last answer until the next one is there", async () => {
  const { asked, show, text } = stage();
  await show("a");
  expect(text()).toBe("nothing");
  await act(async () => asked[0]?.resolve("A"));
  await show("b");
  expect(text()).toBe("A");
  await act(async () => asked[1]?.resolve("B"));
  expect(text()).toBe("B");
});

it("does not ask again for the same key", async () => {
  const { asked, show } = stage();
  await show("a");
  await show("a");
  expect(asked.map(({ key }) => key)).toEqual(["a"]);
});

it("ignores an answer to an earlier question that comes late", async () => {
  const { asked, show, text } = stage();
  await show("a");
  await show("b");
  await act(async () => asked[1]?.resolve("B"));
  await act(async () => asked[0]?.resolve("A"));
  expect(text()).toBe("B");
});

it("shows what went wrong", async () => {
  const { asked, show, text } = stage();
  await show("a");
  await act(async () => asked[0]?.reject(new Error("No calibration 9.")));
  expect(text()).toBe("No calibration 9.");
});

it("asks again what got no answer once the station is there again, and nothing else", async () => {
  const { asked, show, text } = stage();
  const online = async (is: boolean) => {
    await act(() => {
      station.value = is ? stationNow() : null;
    });
    await act(() => new Promise((later) => setTimeout(later, 10)));
  };
  stopClock();
  await online(false);
  await show("a");
  await act(async () => asked[0]?.reject(new Refused("No answer.")));
  expect(text()).toBe("No answer.");
  await online(true);
  expect(asked).toHaveLength(2);
  await act(async () => asked[1]?.resolve("A"));
  expect(text()).toBe("A");
  await show("b");
  await act(async () => asked[2]?.reject(new Refused("Not there.", null, 404)));
  await online(false);
  await online(true);
  expect(asked).toHaveLength(3);
});
