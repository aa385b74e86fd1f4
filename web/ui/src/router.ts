/** View state lives in the address: which view, which filters, which page. */
import { computed, signal } from "@preact/signals";

/** How often the view has been changed since the page was loaded. */
export const navigations = signal(0);
const address = signal(location.pathname + location.search);
/** How far a view that one goes back to was scrolled; it is there again once the view has its data. */
export let scrolledTo = 0;
addEventListener("popstate", (event) => {
  scrolledTo = (event.state as { scroll?: number } | null)?.scroll ?? 0;
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
    scrolledTo = 0;
  }
  if (to.split("?")[0] !== path.peek()) navigations.value += 1;
  address.value = to;
}
