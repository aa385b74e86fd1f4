/**
 * Distinguishes the input of a barcode scanner from that of a person, in any view and with any focus.
 *
 * A scanner is a keyboard whose keys follow each other within a few milliseconds, ended by Enter or Tab.
 * Before that end the two cannot be distinguished, so characters arrive as usual; then their effect on a
 * field is undone.
 */

/** Time from one key to the next, and from pressing a key to releasing it: a person takes longer. */
const FAST_MS = 30;
/** Time from one key to the next on a slow link or computer, if each key is released as fast. */
const SLOWED_MS = 60;
/** Keys further apart do not belong together; a pause within a scan may have this length. */
const TOGETHER_MS = 300;
const FEWEST = 2;

/** The text that was read. */
export interface Scan {
  text: string;
  /** False if some keys in between are not characters: a part of the text may be missing. */
  readable: boolean;
  /** Whether a secret was being typed in the focused field. */
  secret: boolean;
}

type Key = Pick<
  KeyboardEvent,
  "key" | "timeStamp" | "repeat" | "isComposing" | "ctrlKey" | "altKey" | "metaKey" | "getModifierState"
>;
type Field = HTMLInputElement | HTMLSelectElement | HTMLTextAreaElement;

const MODIFIERS = ["Shift", "Control", "Alt", "AltGraph", "Meta", "CapsLock", "NumLock"];
/** Some scanners send a line feed or carriage return as a control key. */
const ENDS_BY_CONTROL = ["j", "m"];

const withControl = (key: Key) =>
  (key.ctrlKey || key.altKey || key.metaKey) && !key.getModifierState("AltGraph");
const isCharacter = (key: Key) => [...key.key].length === 1 && !withControl(key);
const isEnd = (key: Key) =>
  key.key === "Enter" ||
  key.key === "Tab" ||
  (key.ctrlKey && ENDS_BY_CONTROL.includes(key.key.toLowerCase()));

/** Keys received together so far. */
export class Burst {
  private text = "";
  /** For each key after the first, whether a machine pressed it. */
  private fast: boolean[] = [];
  private readable = true;
  private last = Number.NEGATIVE_INFINITY;
  private released = Number.NEGATIVE_INFINITY;
  private endedAt = Number.NEGATIVE_INFINITY;

  /** Whether the last key was the first character. */
  began = false;

  /**
   * The meaning of a key: the scan that it ends, "machine" for another key not pressed by a person, otherwise
   * null.
   */
  take(key: Key): Omit<Scan, "secret"> | "machine" | null {
    this.began = false;
    if (MODIFIERS.includes(key.key)) return null;
    const gap = key.timeStamp - this.last;
    if (key.repeat || key.isComposing || gap > TOGETHER_MS) this.forget();
    if (key.repeat || key.isComposing) return null;
    if (isEnd(key)) return this.end(key, gap);
    const fast = this.isFast(gap);
    if (!isCharacter(key)) {
      if (fast) this.readable = false;
      else this.forget();
      return null;
    }
    this.began = this.text === "";
    if (!this.began) this.fast.push(fast);
    this.text += key.key;
    this.last = key.timeStamp;
    return fast && !this.began ? "machine" : null;
  }

  /** The key pressed last has been released. */
  release(timeStamp: number): void {
    this.released = timeStamp;
  }

  private isFast(gap: number): boolean {
    const heldMs = this.released - this.last;
    return gap < FAST_MS || (gap < SLOWED_MS && heldMs >= 0 && heldMs < FAST_MS);
  }

  private end(key: Key, gap: number): ReturnType<Burst["take"]> {
    const { text, readable } = this;
    const last = this.isFast(gap);
    const fast = [...this.fast, last].filter(Boolean).length;
    const most = fast > (this.fast.length + 1) / 2;
    this.forget();
    // a scanner that sends two ends, such as CR and LF, has sent one too many
    if (text === "") return key.timeStamp - this.endedAt < TOGETHER_MS ? "machine" : null;
    const whole = text.length >= FEWEST && most;
    if (!whole && !last) return null;
    this.endedAt = key.timeStamp;
    return whole ? { text, readable } : "machine";
  }

  private forget(): void {
    this.text = "";
    this.fast = [];
    this.readable = true;
    this.last = Number.NEGATIVE_INFINITY;
  }
}

/** Handles every scan anywhere in the document. */
export function listen(scanned: (scan: Scan) => void): () => void {
  const burst = new Burst();
  /** Every field that had the focus since the first key: the page may move it while a scan arrives. */
  let touched: NonNullable<ReturnType<typeof fieldNow>>[] = [];
  let blankSwallowed = false;
  const swallow = (event: KeyboardEvent) => {
    event.preventDefault();
    event.stopImmediatePropagation();
  };
  const pressed = (event: KeyboardEvent) => {
    const meaning = burst.take(event);
    if (burst.began) touched = [];
    const here = fieldNow();
    if (here && !touched.some(({ field }) => field === here.field)) touched.push(here);
    if (meaning === null) return;
    if (meaning === "machine") {
      // a blank presses buttons, letters choose from lists; in a text they may still be a person's
      if (!isEnd(event) && isText(document.activeElement)) return;
      blankSwallowed = event.key === " ";
      swallow(event);
      return;
    }
    swallow(event);
    for (const { restore } of touched) restore();
    scanned({ ...meaning, secret: touched.some(({ secret }) => secret) });
  };
  // one browser presses a button when the blank key is released
  const released = (event: KeyboardEvent) => {
    burst.release(event.timeStamp);
    if (event.key !== " " || !blankSwallowed) return;
    blankSwallowed = false;
    swallow(event);
  };
  document.addEventListener("keydown", pressed, { capture: true });
  document.addEventListener("keyup", released, { capture: true });
  return () => {
    document.removeEventListener("keydown", pressed, { capture: true });
    document.removeEventListener("keyup", released, { capture: true });
  };
}

const isField = (element: Element | null): element is Field => !!element?.matches("input, select, textarea");
const isText = (element: Element | null) => isField(element) && !element.matches("select, [type=checkbox]");

/** The focused field, and a function to restore its present value. */
function fieldNow() {
  const field = document.activeElement;
  if (!isField(field)) return null;
  const { value } = field;
  return {
    field,
    secret: field instanceof HTMLInputElement && field.type === "password",
    restore: () => {
      if (field.value === value) return;
      field.value = value;
      field.dispatchEvent(new Event("input", { bubbles: true }));
      // the page receives a change of a list or a date when it is chosen, of a text only when the field loses
      // the focus
      if (field.matches("select, [type=date]")) field.dispatchEvent(new Event("change", { bubbles: true }));
    },
  };
}
