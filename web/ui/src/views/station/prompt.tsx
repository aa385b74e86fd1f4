import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { answer, Refused } from "../../api";
import { duration } from "../../format";
import { clock, connected, station } from "../../live";
import { t } from "../../messages";
import { operator } from "../../operator";

/** What a run that waits asks, with the field for its answer and the time that is left. */
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
  const leftS = Math.max(0, (Date.parse(prompt.expires_at) - clock.value.getTime()) / 1000);
  const send = async (event: Event) => {
    event.preventDefault();
    const text = typed.value.trim().replace(",", ".");
    if (prompt.kind === "number" && (text === "" || !Number.isFinite(Number(text)))) {
      trouble.value = t.station.promptNumber(prompt.unit ?? "");
      return;
    }
    try {
      const value = prompt.kind === "number" ? Number(text) : null;
      await answer(run.id, prompt.id, value, operator.value.trim() || "page");
    } catch (error) {
      trouble.value = error instanceof Refused ? error.message : String(error);
    }
  };
  return (
    <form class="prompt" onSubmit={(event) => void send(event)} autocomplete="off">
      <p role="status">
        <strong>{prompt.text}</strong>
      </p>
      {prompt.kind === "number" && (
        <p class="field">
          <label for="answer">{t.station.promptValue(prompt.unit ?? "")}</label>
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
      <button class="act" type="submit" ref={button} disabled={!connected.value}>
        {prompt.kind === "number" ? t.station.promptSend : t.station.promptDone}
      </button>
    </form>
  );
}
