import { t } from "../../messages";
import { navigate, path, query } from "../../router";
import type { Verdict } from "../../types";
import { address, withFilter } from "./address";

/** Verdicts of runs; a diagnosis has more. */
const VERDICTS = { pass: t.verdicts.pass, fail: t.verdicts.fail } satisfies Record<Verdict, unknown>;

/** A separate component: events of the station must not overwrite text being typed. */
export function Filters() {
  const filters = query.value;
  return (
    <form class="filters panel" onSubmit={(event) => event.preventDefault()} aria-label={t.history.filter}>
      <p class="field">
        <label for="filter-serial">{t.history.serial}</label>
        <input
          id="filter-serial"
          value={filters.get("search") ?? filters.get("robot_serial") ?? ""}
          maxLength={64}
          spellcheck={false}
          onChange={(event) => set("search", event.currentTarget.value.trim())}
        />
      </p>
      <p class="field">
        <label for="filter-type">{t.history.type}</label>
        <input
          id="filter-type"
          value={filters.get("robot_type") ?? ""}
          maxLength={64}
          spellcheck={false}
          onChange={(event) => set("robot_type", event.currentTarget.value.trim())}
        />
      </p>
      <p class="field">
        <label for="filter-order">{t.history.workOrder}</label>
        <input
          id="filter-order"
          value={filters.get("work_order") ?? ""}
          maxLength={64}
          spellcheck={false}
          onChange={(event) => set("work_order", event.currentTarget.value.trim())}
        />
      </p>
      <Choice name="state" label={t.history.state} options={t.states} value={filters.get("state") ?? ""} />
      <Choice
        name="verdict"
        label={t.history.verdict}
        options={VERDICTS}
        value={filters.get("verdict") ?? ""}
      />
      <Day name="since" label={t.history.from} value={filters.get("since") ?? ""} />
      <Day name="until" label={t.history.to} value={filters.get("until") ?? ""} />
    </form>
  );
}

function set(name: string, value: string): void {
  // a field that loses the focus with the view still reports its text
  if (path.value !== "/history") return;
  // the present address: another filter may have been set since the form was drawn
  navigate(address(withFilter(query.value, name, value)), { replace: true });
}

interface FieldProps {
  name: string;
  label: string;
  value: string;
}

function Choice({ name, label, value, options }: FieldProps & { options: Record<string, { name: string }> }) {
  return (
    <p class="field">
      <label for={`filter-${name}`}>{label}</label>
      <select id={`filter-${name}`} value={value} onChange={(event) => set(name, event.currentTarget.value)}>
        <option value="">{t.history.all}</option>
        {Object.entries(options).map(([id, option]) => (
          <option key={id} value={id}>
            {option.name}
          </option>
        ))}
      </select>
    </p>
  );
}

function Day({ name, label, value }: FieldProps) {
  return (
    <p class="field">
      <label for={`filter-${name}`}>{label}</label>
      <input
        id={`filter-${name}`}
        type="date"
        value={value}
        onChange={(event) => set(name, event.currentTarget.value)}
      />
    </p>
  );
}
