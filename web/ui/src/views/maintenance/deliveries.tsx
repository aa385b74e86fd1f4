/** Delivered and pending events of other systems. */
import { useSignal } from "@preact/signals";
import { dateTime } from "../../format";
import { t } from "../../messages";
import { said } from "../../messages/said";
import { useLoaded } from "../../parts/load";
import { navigate, query } from "../../router";
import type { Delivery } from "../../types";
import { ActionButton, Pending } from "./action";
import { may, Needs } from "./allowed";
import { deliveries, resend } from "./calls";
import { ChoiceField } from "./fields";
import { Table } from "./table";

const ALARM: Record<Delivery["state"], string> = {
  waiting: "",
  delivered: "",
  refused: "alarm act",
  expired: "alarm act",
};

export function DeliveriesPart() {
  const m = t.maintenance;
  const state = query.value.get("state") ?? "";
  const cursor = query.value.get("cursor") ?? "";
  const sent = useSignal(0);
  const asked = new URLSearchParams({ limit: "50", ...(state && { state }), ...(cursor && { cursor }) });
  const { value: page, trouble } = useLoaded(`${asked} ${sent.value}`, () => deliveries(asked)).value;
  const next = page?.next ?? null;
  return (
    <section class="panel part" aria-labelledby="deliveries-title">
      <h2 id="deliveries-title">{m.deliveries}</h2>
      <div class="fields">
        <ChoiceField
          id="delivery-state"
          label={m.state}
          value={state}
          options={[["", m.allStates], ...Object.entries(m.deliveryStates)]}
          choose={(wanted) => show(wanted, "")}
        />
      </div>
      {!may("maintain") && <Needs permission="maintain">{null}</Needs>}
      {page && page.items.length > 0 && (
        <Table
          label={m.deliveries}
          head={[m.receiver, m.event, m.type, m.state, m.tries, m.detail, m.resend]}
        >
          {page.items.map((delivery) => (
            <tr key={delivery.id}>
              <td class="text wrapped">{delivery.receiver}</td>
              <td class="text">{delivery.event}</td>
              <td class="text">{delivery.type}</td>
              <td class="text">
                <strong class={ALARM[delivery.state]}>{m.deliveryStates[delivery.state]}</strong>
                {delivery.ended_at && <small> {dateTime(delivery.ended_at)}</small>}
              </td>
              <td class="text">{delivery.tries}</td>
              <td class="text wrapped">{delivery.detail && said(delivery.detail)}</td>
              <td class="text">
                <ActionButton
                  label={m.resendOf(delivery.id)}
                  disabled={!may("maintain") || delivery.state === "waiting"}
                  act={async () => {
                    await resend(delivery.id);
                    sent.value += 1;
                  }}
                >
                  {m.resend}
                </ActionButton>
              </td>
            </tr>
          ))}
        </Table>
      )}
      {!page && <Pending trouble={trouble} />}
      {page?.items.length === 0 && <p class="empty">{m.noDeliveries}</p>}
      <p class="actions">
        <button type="button" disabled={!cursor} onClick={() => show(state, "")}>
          {m.newest}
        </button>
        <button type="button" disabled={next === null} onClick={() => show(state, String(next))}>
          {m.older}
        </button>
      </p>
    </section>
  );
}

const show = (state: string, cursor: string) =>
  navigate(
    `/maintenance?${new URLSearchParams({ part: "deliveries", ...(state && { state }), ...(cursor && { cursor }) })}`,
  );
