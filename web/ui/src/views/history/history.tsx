/** Every run, newest first.  Filters and page live in the address. */
import { calibrations, type Summary } from "../../api";
import { dateTime, fixed, signed } from "../../format";
import { station } from "../../live";
import { Link } from "../../parts/link";
import { useLoaded } from "../../parts/load";
import { Badge } from "../../parts/verdict";
import { navigate, query } from "../../router";

const PAGE = "20";
const STATES: Summary["state"][] = ["queued", "running", "succeeded", "failed", "aborted", "interrupted"];

export function HistoryView() {
  const filters = query.value;
  // asked again when a run starts or ends
  const latest = `${station.value?.run?.id} ${station.value?.last?.id}`;
  const { value: page, trouble } = useLoaded(`${filters} ${latest}`, () => calibrations(toApi(filters))).value;
  const older = new URLSearchParams(filters);
  if (page?.next) older.set("cursor", String(page.next));
  const newest = new URLSearchParams(filters);
  newest.delete("cursor");
  return (
    <div class="history">
      <h1 class="hidden">History</h1>
      <Filters />
      <section class="panel list">
        <div class="scroll" tabIndex={0} role="region" aria-label="Runs">
          <table>
            <thead>
              <tr>
                <th scope="col">Run</th>
                <th scope="col" class="text">
                  Started
                </th>
                <th scope="col" class="text">
                  Robot
                </th>
                <th scope="col" class="text">
                  Outcome and reason
                </th>
                <th scope="col">Offset 1 ± U, °</th>
                <th scope="col">Offset 2 ± U, °</th>
                <th scope="col" class="text">
                  Readings
                </th>
              </tr>
            </thead>
            <tbody>{page?.items.map((run) => <Row key={run.id} run={run} />)}</tbody>
          </table>
          <p class="empty" role="status">
            {trouble ? `▲ ${trouble}` : !page ? "Loading …" : page.items.length === 0 ? "No run matches." : ""}
          </p>
        </div>
        <p class="actions">
          <button type="button" disabled={!filters.has("cursor")} onClick={() => navigate(address(newest))}>
            Newest
          </button>
          <button type="button" disabled={!page?.next} onClick={() => navigate(address(older))}>
            Older
          </button>
        </p>
      </section>
    </div>
  );
}

/** A part of its own: what the station tells meanwhile must not take away what is being typed. */
function Filters() {
  const filters = query.value;
  const set = (name: string, value: string) => {
    // the address as it is now: another filter may have been set since this was drawn
    const next = new URLSearchParams(query.value);
    next.delete("cursor");
    if (value) next.set(name, value);
    else next.delete(name);
    navigate(address(next), { replace: true });
  };
  return (
    <form class="filters panel" onSubmit={(event) => event.preventDefault()} aria-label="Filter">
      <p class="field">
        <label for="filter-serial">Robot serial</label>
        <input
          id="filter-serial"
          value={filters.get("robot_serial") ?? ""}
          spellcheck={false}
          onChange={(event) => set("robot_serial", event.currentTarget.value.trim())}
        />
      </p>
      <Choice name="state" label="State" options={STATES} value={filters.get("state") ?? ""} set={set} />
      <Choice name="verdict" label="Verdict" options={["pass", "fail"]} value={filters.get("verdict") ?? ""} set={set} />
      <Day name="since" label="From" value={filters.get("since") ?? ""} set={set} />
      <Day name="until" label="To" value={filters.get("until") ?? ""} set={set} />
    </form>
  );
}

function Row({ run }: { run: Summary }) {
  const offset = (joint: number) => run.zero_offsets?.find((zero) => zero.joint === joint);
  const cell = (joint: number) => {
    const zero = offset(joint);
    return zero ? `${signed(zero.value_deg, 3)} ± ${fixed(zero.sd_deg === null ? null : 2 * zero.sd_deg, 3)}` : "–";
  };
  return (
    <tr>
      <td>
        <Link class="cell" to={`/result/${run.id}`}>
          {run.id}
        </Link>
      </td>
      <td class="text">{dateTime(run.started_at ?? run.created_at)}</td>
      <td class="text serial">{run.robot_serial}</td>
      <td class="text outcome-cell">
        <Badge run={run} />
        {run.of !== null && ` ${run.plan} of run ${run.of}`}
        {run.reason && <small>{run.reason}</small>}
      </td>
      <td>{cell(1)}</td>
      <td>{cell(2)}</td>
      <td class="text">
        <a class="cell" href={`/api/v1/calibrations/${run.id}/readings.csv`} download aria-label={`Readings of run ${run.id}, CSV`}>
          CSV
        </a>
      </td>
    </tr>
  );
}

interface ChoiceProps {
  name: string;
  label: string;
  value: string;
  set: (name: string, value: string) => void;
}

function Choice({ name, label, value, set, options }: ChoiceProps & { options: string[] }) {
  return (
    <p class="field">
      <label for={`filter-${name}`}>{label}</label>
      <select id={`filter-${name}`} value={value} onChange={(event) => set(name, event.currentTarget.value)}>
        <option value="">all</option>
        {options.map((option) => (
          <option value={option}>{option}</option>
        ))}
      </select>
    </p>
  );
}

function Day({ name, label, value, set }: ChoiceProps) {
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

function address(filters: URLSearchParams): string {
  const text = filters.toString();
  return text ? `/history?${text}` : "/history";
}

/** Days in the address are the operator's days; the service is asked in absolute times. */
function toApi(filters: URLSearchParams): URLSearchParams {
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
