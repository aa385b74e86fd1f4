/** View state lives in the address: which view, which filters, which page. */
import { computed, signal } from "@preact/signals";

/** How often the view has been changed since the page was loaded. */
export const navigations = signal(0);
const address = signal(location.pathname + location.search);
addEventListener("popstate", () => {
  navigations.value += 1;
  address.value = location.pathname + location.search;
});

export const path = computed(() => address.value.split("?")[0]!);
export const query = computed(() => new URLSearchParams(address.value.split("?")[1] ?? ""));

export function navigate(to: string, options: { replace?: boolean } = {}): void {
  if (options.replace) history.replaceState(null, "", to);
  else history.pushState(null, "", to);
  if (to.split("?")[0] !== path.peek()) navigations.value += 1;
  address.value = to;
}
