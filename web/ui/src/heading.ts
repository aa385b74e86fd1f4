/** The title is that of the view; after a change of view the focus is at its heading, also when that comes late. */
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
  // the heading of a view that waits for its data is replaced; who has gone on meanwhile is left alone
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
