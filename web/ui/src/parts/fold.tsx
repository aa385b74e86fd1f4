/** A section that is folded until it is opened; the address lists the open ones as `open`. */
import type { ComponentChildren } from "preact";
import { query } from "../router";
import { setQuery } from "./set-query";

const SEPARATOR = ".";

const opened = () => new Set(query.value.get("open")?.split(SEPARATOR).filter(Boolean));

interface Props {
  /** Its identifier in the address. */
  name: string;
  title: string;
  children: ComponentChildren;
}

export function Fold({ name, title, children }: Props) {
  const open = opened().has(name);
  const toggled = (now: boolean) => {
    const names = opened();
    if (now === names.has(name)) return;
    if (now) names.add(name);
    else names.delete(name);
    setQuery("open", [...names].join(SEPARATOR));
  };
  return (
    <details
      class="fold wide"
      aria-label={title}
      open={open}
      onToggle={(event) => toggled(event.currentTarget.open)}
    >
      <summary>
        <h2>{title}</h2>
      </summary>
      {/* a closed section is neither loaded nor drawn */}
      {open && <div class="folded">{children}</div>}
    </details>
  );
}
