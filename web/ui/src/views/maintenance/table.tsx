/** A table that scrolls by itself if it is wider than the page. */
import type { ComponentChildren } from "preact";

interface Props {
  label: string;
  head: string[];
  children: ComponentChildren;
}

/** Number of columns that still fit beside each other on a phone. */
const MOST_BESIDE = 5;

export function Table({ label, head, children }: Props) {
  // if a row is shown as a card, each value has its heading beside it
  const heads = Object.fromEntries(head.map((text, n) => [`--head-${n + 1}`, JSON.stringify(text)]));
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label={label}>
      <table class={head.length > MOST_BESIDE ? "plain cards" : "plain"} style={heads}>
        <thead>
          <tr>
            {head.map((text) => (
              <th key={text} scope="col" class="text">
                {text}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>{children}</tbody>
      </table>
    </div>
  );
}
