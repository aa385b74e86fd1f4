/** The filters in the address, and what is asked of the service for them. */
const PAGE = "20";

export function address(filters: URLSearchParams): string {
  const text = filters.toString();
  return text ? `/history?${text}` : "/history";
}

/** The same filters with one of them set, or cleared by an empty value; back on the newest page. */
export function withFilter(filters: URLSearchParams, name: string, value: string): URLSearchParams {
  const next = newest(filters);
  if (value) next.set(name, value);
  else next.delete(name);
  return next;
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
