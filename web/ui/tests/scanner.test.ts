import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { Burst, listen, type Scan } from "../src/scanner";

/** Keys, each with the time since the one before; characters 5 ms apart unless told. */
function typed(keys: (string | [string, number] | [string, number, KeyboardEventInit])[], heldMs = 80) {
  const burst = new Burst();
  let timeStamp = 10_000;
  return keys.map((given) => {
    const [key, gap, more] =
      typeof given === "string" ? [given, 5, {}] : [given[0], given[1], given[2] ?? {}];
    timeStamp += gap;
    const event = new KeyboardEvent("keydown", { key, ...more });
    Object.defineProperty(event, "timeStamp", { value: timeStamp });
    const meaning = burst.take(event);
    burst.release(timeStamp + heldMs);
    return meaning;
  });
}
const text = (characters: string, gap = 5): [string, number][] => [...characters].map((c) => [c, gap]);
const scans = (meanings: ReturnType<typeof typed>) =>
  meanings.flatMap((meaning) => (meaning && meaning !== "machine" ? [meaning] : []));

describe("a burst", () => {
  it.each([
    ["5 ms apart", text("FB-7"), "Enter"],
    ["0 ms apart", text("FB-7", 0), ["Enter", 0]],
    ["29 ms apart", text("FB-7", 29), ["Enter", 29]],
    ["ended by Tab", text("FB-7"), "Tab"],
    ["ended by a line feed", text("FB-7"), ["j", 5, { ctrlKey: true }]],
    ["with a pause in it", [...text("FB"), ["-", 150] as [string, number], ...text("7")], "Enter"],
    ["with a pause after its first character", [["F", 5], ["B", 150], ...text("-7")], "Enter"],
    ["with Shift", [["Shift", 1], ["F", 1], ["Shift", 1], ["B", 1], ...text("-7")], "Enter"],
  ] as [string, [string, number][], string | [string, number]][])("%s is a scan", (_, keys, end) => {
    expect(scans(typed([...keys, end]))).toEqual([{ text: "FB-7", readable: true }]);
  });

  it("over a slow link is a scan by the short time for which each key is down", () => {
    const keys: [string, number][] = [...text("FB-7", 50), ["Enter", 50]];
    expect(scans(typed(keys, 10))).toHaveLength(1);
    expect(scans(typed(keys, 45))).toHaveLength(0);
  });

  it("keeps two scans apart that follow each other at once, and drops the second of two ends", () => {
    const found = typed([
      ...text("FB-6"),
      "Enter",
      "Enter",
      ...text("FB-7"),
      "Enter",
      ["j", 5, { ctrlKey: true }],
    ]);
    expect(scans(found).map((scan) => scan.text)).toEqual(["FB-6", "FB-7"]);
    expect([found[5], found[11]]).toEqual(["machine", "machine"]);
  });

  it.each([
    ["an arrow", ["ArrowLeft", 5]],
    ["a dead key", ["Dead", 5]],
    ["a control key", ["b", 5, { ctrlKey: true }]],
  ] as [string, [string, number, KeyboardEventInit?]][])("with %s in it is not readable", (_, key) => {
    const found = typed([...text("FB"), key as [string, number, KeyboardEventInit], ...text("-7"), "Enter"]);
    expect(scans(found).map((scan) => scan.readable)).toEqual([false]);
  });

  it.each([
    ["a person types", [...text("FB-7", 90), ["Enter", 200]]],
    ["a quick person types", [...text("FB-7", 45), ["Enter", 60]]],
    [
      "a person presses two keys at once",
      [
        ["F", 90],
        ["B", 12],
        ["-", 80],
        ["7", 70],
        ["Enter", 90],
      ],
    ],
    ["a person takes the time for Enter", [...text("FB-7"), ["Enter", 400]]],
    ["a key is held", [["f", 90], ...Array(9).fill(["f", 20, { repeat: true }]), ["Enter", 20]]],
    [
      "a word is composed",
      [
        ["f", 5, { isComposing: true }],
        ["b", 5, { isComposing: true }],
        ["Enter", 5, { isComposing: true }],
      ],
    ],
    ["Enter comes alone", [["Enter", 5]]],
  ] as [string, [string, number][]][])("is none when %s, and Enter stays Enter", (_, keys) => {
    const found = typed(keys);
    expect(scans(found)).toEqual([]);
    expect(found.at(-1)).toBeNull();
  });

  it("of one character is none, but its Enter is not a person's", () => {
    expect(typed(["7", "Enter"])).toEqual([null, "machine"]);
  });
});

describe("listening", () => {
  let stop: () => void;
  let clock = 0;
  const found = vi.fn<(scan: Scan) => void>();
  const key = (name: string, gap = 5, type = "keydown") => {
    clock += gap;
    const event = new KeyboardEvent(type, { key: name, bubbles: true, cancelable: true });
    Object.defineProperty(event, "timeStamp", { value: clock });
    const target = document.activeElement as HTMLInputElement;
    target.dispatchEvent(event);
    if (!event.defaultPrevented && name.length === 1 && target.matches("input")) {
      target.value += name;
      target.dispatchEvent(new Event("input", { bubbles: true }));
    }
    return event;
  };
  const scan = (code: string) => {
    for (const c of code) key(c);
    return key("Enter");
  };
  const focused = (html: string) => {
    document.body.innerHTML = html;
    const element = document.body.firstElementChild as HTMLInputElement;
    element.focus();
    return element;
  };

  beforeEach(() => {
    clock += 10_000;
    found.mockReset();
    stop = listen(found);
  });
  afterEach(() => stop());

  it("takes back what a scan typed, and nothing else hears of its end", () => {
    const field = focused("<input value='FB-6'>");
    const heard = vi.fn();
    field.addEventListener("keydown", (event) => event.key === "Enter" && heard());
    const inputs = vi.fn();
    field.addEventListener("input", () => inputs(field.value));
    expect(scan("FB-7").defaultPrevented).toBe(true);
    expect(field.value).toBe("FB-6");
    expect(inputs).toHaveBeenLastCalledWith("FB-6");
    expect(heard).not.toHaveBeenCalled();
    expect(found).toHaveBeenCalledWith({ text: "FB-7", readable: true, secret: false });
  });

  it("takes it back in every field that had the focus while it arrived", () => {
    document.body.innerHTML = "<input value='0.5'><input value='FB-6'>";
    const [first, second] = [...document.querySelectorAll("input")];
    first!.focus();
    for (const c of "FB") key(c);
    second!.focus();
    scan("-7");
    expect([first!.value, second!.value]).toEqual(["0.5", "FB-6"]);
    expect(found).toHaveBeenCalledWith({ text: "FB-7", readable: true, secret: false });
  });

  it("says when a secret was being typed", () => {
    const field = focused("<input type='password' value='12'>");
    scan("FB-7");
    expect(field.value).toBe("12");
    expect(found).toHaveBeenCalledWith({ text: "FB-7", readable: true, secret: true });
  });

  it("leaves alone what a person types", () => {
    const field = focused("<input>");
    for (const c of "FB-7") key(c, 100);
    expect(key("Enter", 100).defaultPrevented).toBe(false);
    expect(field.value).toBe("FB-7");
    expect(found).not.toHaveBeenCalled();
  });

  it("lets no blank of a scan press a button, but one that a person presses", () => {
    focused("<button>Stop</button>");
    key("F");
    expect([key(" "), key(" ", 1, "keyup")].map((event) => event.defaultPrevented)).toEqual([true, true]);
    key("7");
    key("Enter");
    expect([key(" ", 500), key(" ", 60, "keyup")].map((event) => event.defaultPrevented)).toEqual([
      false,
      false,
    ]);
  });

  it("chooses nothing from a list", () => {
    const list = focused("<select><option>paper</option><option>full</option></select>");
    const chosen = vi.fn();
    list.addEventListener("change", () => chosen(list.value));
    key("f");
    list.value = "full"; // as the browser does at a letter
    key("u");
    key("l");
    key("Enter");
    expect(list.value).toBe("paper");
    expect(chosen).toHaveBeenLastCalledWith("paper");
  });
});
