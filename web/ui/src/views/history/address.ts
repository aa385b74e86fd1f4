/** All that the view shows is in the address: filters, order, page, what is compared, and the charts. */
const PAGE = "20";
/** What only the page knows. */
const OF_THE_PAGE = ["show", "a", "b"];
/** What does not change how many runs there are. */
const OF_THE_LIST = ["cursor", "order", "limit"];

export function address(filters: URLSearchParams): string {
  const text = filters.toString();
  return text ? `/history?${text}` : "/history";
}

/** The same with one value set, or cleared by an empty one; back on the first page. */
export function withFilter(filters: URLSearchParams, name: string, value: string): URLSearchParams {
  const next = newest(filters);
  // what is typed takes the place of the one robot that a link led to
  if (name === "search") next.delete("robot_serial");
  if (value) next.set(name, value);
  else next.delete(name);
  return next;
}

/** The same list with another value of what only the page knows. */
export function showing(filters: URLSearchParams, name: string, value: string | null): URLSearchParams {
  const next = new URLSearchParams(filters);
  if (value === null) next.delete(name);
  else next.set(name, value);
  return next;
}

/** One more run to compare; the two that were chosen last stay. */
export function comparing(filters: URLSearchParams, run: number): URLSearchParams {
  const chosen = [filters.get("a"), filters.get("b")].filter((id) => id !== null && id !== String(run));
  const [a, b] = [...chosen, String(run)].slice(-2);
  return showing(showing(filters, "a", a ?? null), "b", b ?? null);
}

export function newest(filters: URLSearchParams): URLSearchParams {
  const first = new URLSearchParams(filters);
  first.delete("cursor");
  return first;
}

export function older(filters: URLSearchParams, cursor: number): URLSearchParams {
  const next = new URLSearchParams(filters);
  next.set("cursor", String(cursor));
  return next;
}

/** Days in the address are the operator's days; the service is asked in absolute times. */
export function toApi(filters: URLSearchParams): URLSearchParams {
  const asked = new URLSearchParams(filters);
  for (const name of OF_THE_PAGE) asked.delete(name);
  asked.set("limit", PAGE);
  const since = filters.get("since");
  const until = filters.get("until");
  if (since) asked.set("since", new Date(`${since}T00:00:00`).toISOString());
  if (until) {
    const end = new Date(`${until}T00:00:00`);
    end.setDate(end.getDate() + 1);
    asked.set("until", end.toISOString());
  }
  return asked;
}

/** The whole list, whatever its page. */
export function toWholeList(filters: URLSearchParams, keep: "order" | null = null): URLSearchParams {
  const asked = toApi(filters);
  for (const name of OF_THE_LIST) if (name !== keep) asked.delete(name);
  return asked;
}
