/** The address contains the complete state of the view: filters, order, page, compared runs, and charts. */
const PAGE = "20";
/** Values that only the page uses. */
const OF_THE_PAGE = ["show", "a", "b"];
/** Values that do not change the number of runs. */
const OF_THE_LIST = ["cursor", "order", "limit"];

export function address(filters: URLSearchParams): string {
  const text = filters.toString();
  return text ? `/history?${text}` : "/history";
}

/** The same with one value set, or removed if empty; back on the first page. */
export function withFilter(filters: URLSearchParams, name: string, value: string): URLSearchParams {
  const next = newest(filters);
  // typed text replaces the one robot that a link led to
  if (name === "search") next.delete("robot_serial");
  if (value) next.set(name, value);
  else next.delete(name);
  return next;
}

/** The same list with another value that only the page uses. */
export function showing(filters: URLSearchParams, name: string, value: string | null): URLSearchParams {
  const next = new URLSearchParams(filters);
  if (value === null) next.delete(name);
  else next.set(name, value);
  return next;
}

/** One more run to compare; the last two chosen remain. */
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

/** Days in the address are in the operator's time zone; the service receives absolute times. */
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

/** The whole list, on any page. */
export function toWholeList(filters: URLSearchParams, keep: "order" | null = null): URLSearchParams {
  const asked = toApi(filters);
  for (const name of OF_THE_LIST) if (name !== keep) asked.delete(name);
  return asked;
}
