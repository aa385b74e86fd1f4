import { type ReadonlySignal, useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { Refused } from "../api";
import { connected } from "../live";

export interface Loaded<T> {
  value: T | null;
  trouble: string | null;
}

/** The station answers the page's feed but not this request. */
const AGAIN_MS = 3000;

/**
 * The answer of `ask`, requested again whenever `key` changes; the last answer is kept until the next one. A
 * request without an answer is repeated as soon as the station is reachable again.
 */
export function useLoaded<T>(key: string, ask: () => Promise<T>): ReadonlySignal<Loaded<T>> {
  const loaded = useSignal<Loaded<T>>({ value: null, trouble: null });
  const tries = useSignal(0);
  const unanswered = useSignal(0);
  const online = connected.value;
  useEffect(() => {
    if (unanswered.value === 0 || !online) return;
    const timer = setTimeout(
      () => {
        tries.value += 1;
      },
      unanswered.value > 1 ? AGAIN_MS : 0,
    );
    return () => clearTimeout(timer);
  }, [online, unanswered.value]);
  useEffect(() => {
    let current = true;
    ask().then(
      (value) => {
        if (!current) return;
        loaded.value = { value, trouble: null };
        unanswered.value = 0;
      },
      (error: Error) => {
        if (!current) return;
        loaded.value = { value: null, trouble: error.message };
        if (isPassing(error)) unanswered.value += 1;
      },
    );
    return () => {
      current = false;
    };
  }, [key, tries.value]);
  return loaded;
}

/** No answer, or one that states that the station cannot answer now. */
const isPassing = (error: Error) =>
  error instanceof Refused && (error.status === null || error.status >= 500);
