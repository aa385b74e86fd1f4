import { navigate, path, query } from "../router";

/**
 * Changes one value of the address; an empty one is removed. The view is unchanged, and so is the browser's
 * history.
 */
export function setQuery(name: string, value: string): void {
  const changed = new URLSearchParams(query.value);
  if (value) changed.set(name, value);
  else changed.delete(name);
  const text = changed.toString();
  navigate(path.value + (text && `?${text}`), { replace: true });
}
