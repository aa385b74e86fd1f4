import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { answer } from "../../api";
import { duration, local } from "../../format";
import { clock, connected, station } from "../../live";
import { t } from "../../messages";
import { said } from "../../messages/said";
import { unitName } from "../../names";
import { operator } from "../../operator";
import { ConfirmedButton } from "../../parts/confirm";
import { MotionWarning } from "../../parts/motion-warning";

/**
 * The prompt of a waiting run, with the field for its answer and the remaining time. After it the robot
 * moves.
 */
export function Prompt() {
  const run = station.value?.run;
  const prompt = run?.prompt ?? null;
  const typed = useSignal("");
  const trouble = useSignal("");
  const field = useRef<HTMLInputElement>(null);
  const button = useRef<HTMLButtonElement>(null);
  useEffect(() => {
    typed.value = "";
    trouble.value = "";
    if (prompt) (field.current ?? button.current)?.focus();
  }, [prompt?.id]);
  if (!run || !prompt) return null;
  const unit = unitName(prompt.unit ?? "");
  const leftS = Math.max(0, (Date.parse(prompt.expires_at) - clock.value.getTime()) / 1000);
  const text = typed.value.trim().replace(",", ".");
  const isNumber = prompt.kind === "number";
  const check = () => {
    const wrong = isNumber && (text === "" || !Number.isFinite(Number(text)));
    trouble.value = wrong ? t.station.promptNumber(unit) : "";
    if (wrong) field.current?.focus();
    return !wrong;
  };
  return (
    <form
      class="prompt"
      onSubmit={(event) => {
        event.preventDefault();
        button.current?.focus();
      }}
      autocomplete="off"
    >
      <p role="status">
        <strong>{said(prompt.text)}</strong>
      </p>
      {isNumber && (
        <p class="field">
          <label for="answer">{t.station.promptValue(unit)}</label>
          <input
            id="answer"
            ref={field}
            inputMode="decimal"
            value={typed.value}
            aria-describedby="prompt-trouble"
            onInput={(event) => {
              typed.value = event.currentTarget.value;
            }}
          />
        </p>
      )}
      <p id="prompt-trouble" role="alert" class={trouble.value ? "trouble" : ""}>
        {trouble.value && `▲ ${trouble.value}`}
      </p>
      <p class="note">{t.station.promptLeft(duration(leftS))}</p>
      <ConfirmedButton
        label={isNumber ? t.station.promptSend : t.station.promptDone}
        prominent
        disabled={!connected.value}
        button={button}
        about={`${prompt.id} ${text}`}
        check={check}
        act={() => answer(run.id, prompt.id, isNumber ? Number(text) : null, operator.value.trim() || "page")}
      >
        {isNumber && (
          <strong>{t.station.promptAnswer(`${local(text)}${unit === "°" ? "" : " "}${unit}`)} </strong>
        )}
        <MotionWarning serial={run.robot_serial} />
      </ConfirmedButton>
    </form>
  );
}
