import { newKey, retract } from "../../api";
import { connected, station } from "../../live";
import { t } from "../../messages";
import { said } from "../../messages/said";
import { keepOperator, operator } from "../../operator";
import { ConfirmedButton } from "../../parts/confirm";
import { OperatorField } from "../../parts/operator-field";

/** The return into the workspace, offered while the arm is outside. */
export function Retract() {
  const now = station.value;
  const idle = connected.value && !now?.run && operator.value.trim() !== "";
  const act = () => {
    keepOperator();
    return retract(operator.value.trim(), newKey());
  };
  return (
    <section class="panel" aria-label={t.station.wayBack} hidden={!now?.retract.needed}>
      {now?.retract.needed && (
        <>
          <h2>{t.station.wayBack}</h2>
          <p class="alarm warn">◆ {said(now.retract.text)}</p>
          <OperatorField id="retract-operator" />
          <ConfirmedButton label={t.station.retract} disabled={!idle} act={act}>
            <strong>{said(now.retract.text)}</strong>
            {t.station.retractHow} {t.shared.clear}
          </ConfirmedButton>
        </>
      )}
    </section>
  );
}
