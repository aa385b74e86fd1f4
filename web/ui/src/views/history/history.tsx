/** All runs. Filters, order, page, comparison and charts are in the address. */
import { calibrations, countRuns } from "../../api";
import { K } from "../../format";
import { station } from "../../live";
import { t } from "../../messages";
import { Link } from "../../parts/link";
import { useLoaded } from "../../parts/load";
import { navigate, query } from "../../router";
import { address, newest, older, showing, toApi, toWholeList, withFilter } from "./address";
import { Compare } from "./compare";
import { Filters } from "./filters";
import { Process } from "./process";
import { RunRow } from "./run-row";

export function HistoryView() {
  const filters = query.value;
  // requested again when a run starts or ends
  const latest = `${station.value?.run?.id} ${station.value?.last?.id}`;
  const { value: page, trouble } = useLoaded(`${toApi(filters)} ${latest}`, () =>
    calibrations(toApi(filters)),
  ).value;
  const { value: counted } = useLoaded(`${toWholeList(filters)} ${latest}`, () =>
    countRuns(toWholeList(filters)),
  ).value;
  const next = page?.next ?? null;
  const charts = filters.get("show") === "process";
  return (
    <div class="history">
      <h1 class="hidden">{t.history.title}</h1>
      <Filters />
      <Compare a={filters.get("a")} b={filters.get("b")} />
      {charts && (
        <Process serial={filters.get("robot_serial")} type={filters.get("robot_type")} latest={latest} />
      )}
      <section class="panel list">
        <p class="actions found">
          <strong role="status">{counted && t.history.found(counted.count, counted.more)}</strong>
          <Link
            class="button"
            to={address(showing(filters, "show", charts ? null : "process"))}
            current={charts}
          >
            {t.history.process}
          </Link>
          <a
            class="button"
            href={`/api/v1/calibrations.csv?${toWholeList(filters, "order")}`}
            download="runs.csv"
          >
            {t.history.listCsv}
          </a>
        </p>
        <div class="scroll" tabIndex={0} role="region" aria-label={t.history.runs}>
          <table>
            <Head />
            <tbody>
              {page?.items.map((run) => (
                <RunRow key={run.id} run={run} />
              ))}
            </tbody>
          </table>
          <p class="empty" role="status">
            {trouble
              ? t.history.trouble(trouble)
              : page
                ? page.items.length === 0 && t.history.noMatch
                : t.shared.loading}
          </p>
        </div>
        <p class="note">{t.shared.expanded(K)}</p>
        <p class="actions">
          <button
            type="button"
            disabled={!filters.has("cursor")}
            onClick={() => navigate(address(newest(filters)))}
          >
            {t.history.firstPage}
          </button>
          <button
            type="button"
            disabled={next === null}
            onClick={() => next !== null && navigate(address(older(filters, next)))}
          >
            {t.history.nextPage}
          </button>
        </p>
      </section>
    </div>
  );
}

const UP = "▲";
const DOWN = "▼";

function Head() {
  return (
    <thead>
      <tr>
        <Sorted name={t.history.run} up="oldest" down="" />
        <th scope="col" class="text">
          {t.history.started}
        </th>
        <Sorted name={t.history.robot} up="serial" down="serial_down" text />
        <th scope="col" class="text">
          {t.history.workOrder}
        </th>
        <th scope="col" class="text">
          {t.history.outcome}
        </th>
        <th scope="col">{t.history.offsets}</th>
        <th scope="col" class="text">
          {t.history.readings}
        </th>
        <th scope="col" class="text">
          {t.history.compare}
        </th>
      </tr>
    </thead>
  );
}

/** The head of a column that orders the list, in one direction and then the other. */
function Sorted({ name, up, down, text }: { name: string; up: string; down: string; text?: boolean }) {
  const order = query.value.get("order") ?? "";
  const shape = order === up ? UP : order === down ? DOWN : "";
  const sort = shape === UP ? "ascending" : shape === DOWN ? "descending" : "none";
  return (
    <th scope="col" class={text ? "text" : ""} aria-sort={sort}>
      <button
        type="button"
        class="sort"
        onClick={() =>
          navigate(address(withFilter(query.value, "order", shape === UP ? down : up)), { replace: true })
        }
      >
        {name} <span aria-hidden="true">{shape || "↕"}</span>
      </button>
    </th>
  );
}
