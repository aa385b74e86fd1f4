/**
 * The title is that of the view; after a change of view its heading gets the focus, also if it appears late.
 */
import { effect } from "@preact/signals";
import { t } from "./messages";
import { navigations, path } from "./router";

export function followHeading(main: HTMLElement): () => void {
  let changed = false;
  const follow = () => {
    const heading = main.querySelector("h1");
    document.title = heading ? `${heading.textContent} – ${t.title}` : t.title;
    if (!changed || !heading || main.contains(document.activeElement)) return;
    heading.tabIndex = -1;
    heading.focus({ preventScroll: true });
  };
  // the heading of a view that waits for its data is replaced; a focus moved meanwhile is not changed
  const goesOn = () => {
    changed = false;
  };
  const watched = new MutationObserver(follow);
  watched.observe(main, { childList: true, subtree: true, characterData: true });
  const unwatch = effect(() => {
    path.value;
    changed = navigations.value > 0;
    queueMicrotask(follow);
  });
  document.addEventListener("keydown", goesOn, { capture: true });
  document.addEventListener("pointerdown", goesOn, { capture: true });
  return () => {
    watched.disconnect();
    unwatch();
    document.removeEventListener("keydown", goesOn, { capture: true });
    document.removeEventListener("pointerdown", goesOn, { capture: true });
  };
}
