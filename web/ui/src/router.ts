/** View state is in the address: view, filters, page. */
import { computed, signal } from "@preact/signals";

/** Number of changes of the view since the page was loaded. */
export const navigations = signal(0);
const address = signal(location.pathname + location.search);
let stay = new AbortController();
addEventListener("popstate", (event) => {
  holdAt((event.state as { scroll?: number } | null)?.scroll ?? 0);
  navigations.value += 1;
  address.value = location.pathname + location.search;
});

export const path = computed(() => address.value.split("?")[0]!);
export const query = computed(() => new URLSearchParams(address.value.split("?")[1] ?? ""));

export function navigate(to: string, options: { replace?: boolean } = {}): void {
  if (options.replace) history.replaceState(null, "", to);
  else {
    history.replaceState({ scroll: scrollY }, "");
    history.pushState(null, "", to);
    stay.abort();
  }
  if (to.split("?")[0] !== path.peek()) navigations.value += 1;
  address.value = to;
}

/** Restores the scroll position of the view while its parts are loaded, until the user scrolls. */
function holdAt(top: number): void {
  stay.abort();
  stay = new AbortController();
  const grown = new ResizeObserver(() => scrollTo(0, top));
  grown.observe(document.body);
  stay.signal.addEventListener("abort", () => grown.disconnect());
  for (const moved of ["wheel", "touchmove", "pointerdown", "keydown"])
    addEventListener(moved, () => stay.abort(), { signal: stay.signal, passive: true });
}
