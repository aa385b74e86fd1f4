import { type ReadonlySignal, useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";

export interface Loaded<T> {
  value: T | null;
  trouble: string | null;
}

/** What `ask` answers, asked again whenever `key` changes; the last answer stays until the next is there. */
export function useLoaded<T>(key: string, ask: () => Promise<T>): ReadonlySignal<Loaded<T>> {
  const loaded = useSignal<Loaded<T>>({ value: null, trouble: null });
  useEffect(() => {
    let current = true;
    ask().then(
      (value) => {
        if (current) loaded.value = { value, trouble: null };
      },
      (error: Error) => {
        if (current) loaded.value = { value: null, trouble: error.message };
      },
    );
    return () => {
      current = false;
    };
  }, [key]);
  return loaded;
}
