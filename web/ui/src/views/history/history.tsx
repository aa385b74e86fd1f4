/** Every run, newest first.  Filters and page live in the address. */
import { calibrations } from "../../api";
import { station } from "../../live";
import { t } from "../../messages";
import { useLoaded } from "../../parts/load";
import { navigate, query } from "../../router";
import { address, newest, older, toApi } from "./address";
import { Filters } from "./filters";
import { RunRow } from "./run-row";

export function HistoryView() {
  const filters = query.value;
  // asked again when a run starts or ends
  const latest = `${station.value?.run?.id} ${station.value?.last?.id}`;
  const { value: page, trouble } = useLoaded(`${filters} ${latest}`, () =>
    calibrations(toApi(filters)),
  ).value;
  const next = page?.next ?? null;
  return (
    <div class="history">
      <h1 class="hidden">{t.history.title}</h1>
      <Filters />
      <section class="panel list">
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
        <p class="actions">
          <button
            type="button"
            disabled={!filters.has("cursor")}
            onClick={() => navigate(address(newest(filters)))}
          >
            {t.history.newest}
          </button>
          <button
            type="button"
            disabled={next === null}
            onClick={() => next !== null && navigate(address(older(filters, next)))}
          >
            {t.history.older}
          </button>
        </p>
      </section>
    </div>
  );
}

function Head() {
  return (
    <thead>
      <tr>
        <th scope="col">{t.history.run}</th>
        <th scope="col" class="text">
          {t.history.started}
        </th>
        <th scope="col" class="text">
          {t.history.robot}
        </th>
        <th scope="col" class="text">
          {t.history.outcome}
        </th>
        <th scope="col">{t.history.offset(1)}</th>
        <th scope="col">{t.history.offset(2)}</th>
        <th scope="col" class="text">
          {t.history.readings}
        </th>
      </tr>
    </thead>
  );
}
