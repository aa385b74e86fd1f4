/** The examination of all devices, with remedies for its findings. */
import { useSignal } from "@preact/signals";
import { station } from "../../live";
import { t } from "../../messages";
import { said } from "../../messages/said";
import type { Found } from "../../types";
import { ActionButton } from "./action";
import { Needs } from "./allowed";
import { examine } from "./calls";

const ALARMS = { ok: "", note: "alarm warn", trouble: "alarm act" };

export function Doctor() {
  const found = useSignal<Found | null>(null);
  const act = async () => {
    found.value = await examine();
  };
  return (
    <section class="panel part" aria-labelledby="doctor-title">
      <h2 id="doctor-title">{t.maintenance.doctor}</h2>
      <p>{t.maintenance.doctorNote}</p>
      <Needs permission="maintain">
        <ActionButton act={act} disabled={Boolean(station.value?.run)}>
          {t.maintenance.examine}
        </ActionButton>
        <div role="status">
          {found.value && (
            <>
              <p class="main">{troubled(found.value) ? t.maintenance.notHealthy : t.maintenance.healthy}</p>
              <ul class="findings">
                {found.value.parts.map((part) => (
                  <FoundItem key={part.text} found={part} />
                ))}
              </ul>
            </>
          )}
        </div>
      </Needs>
    </section>
  );
}

const troubled = (found: Found): boolean => found.condition === "trouble" || found.parts.some(troubled);

function FoundItem({ found }: { found: Found }) {
  return (
    <li>
      {found.condition !== "ok" && (
        <strong class={ALARMS[found.condition]}>{t.maintenance.conditions[found.condition]}</strong>
      )}{" "}
      {said(found.text)}
      {found.do && <p class="todo">{t.maintenance.todo(said(found.do))}</p>}
      {found.parts.length > 0 && (
        <ul>
          {found.parts.map((part) => (
            <FoundItem key={part.text} found={part} />
          ))}
        </ul>
      )}
    </li>
  );
}
