/** Choice of the error: kind, joint and size. */
import { useComputed, useSignal } from "@preact/signals";
import { local } from "../../format";
import { station } from "../../live";
import { t } from "../../messages";
import { unitName } from "../../names";
import type { Challenge, Training } from "../../types";
import { ActionButton } from "./action";
import { choose } from "./calls";
import { challengeName } from "./exercises";
import { ChoiceField, TextField } from "./fields";

interface Props {
  challenges: Challenge[];
  after: (asked: Promise<Training>) => Promise<void>;
}

const GROUPS = ["catalogue", "unnamed", "fault"] as const;

export function ChooseExercise({ challenges, after }: Props) {
  const first = challenges[0]!;
  const kind = useSignal(first.kind);
  const joint = useSignal("1");
  const size = useSignal(local(String(first.usual ?? "")));
  const chosen = useComputed(() => challenges.find((one) => one.kind === kind.value) ?? first);
  const { smallest, largest, unit, joint: atJoint } = chosen.value;
  const act = () => {
    const given = Number(size.value.trim().replace(",", "."));
    if (smallest !== null && (size.value.trim() === "" || !Number.isFinite(given)))
      return Promise.reject(new Error(t.training.sizeWrong));
    return after(
      choose({
        kind: kind.value,
        joint: atJoint ? Number(joint.value) : null,
        size: smallest === null ? null : given,
      }),
    );
  };
  return (
    <div class="fields">
      <p class="field">
        <label for="exercise-kind">{t.training.kind}</label>
        <select
          id="exercise-kind"
          value={kind.value}
          onChange={(event) => {
            kind.value = event.currentTarget.value;
            size.value = local(String(chosen.value.usual ?? ""));
          }}
        >
          {GROUPS.map((group) => (
            <optgroup key={group} label={t.training.groups[group]}>
              {challenges
                .filter((one) => one.group === group)
                .map((one) => (
                  <option key={one.kind} value={one.kind}>
                    {challengeName(one.kind)}
                  </option>
                ))}
            </optgroup>
          ))}
        </select>
      </p>
      {atJoint && (
        <ChoiceField
          id="exercise-joint"
          label={t.training.joint}
          value={joint.value}
          options={[
            ["1", "1"],
            ["2", "2"],
          ]}
          choose={(wanted) => {
            joint.value = wanted;
          }}
        />
      )}
      {smallest !== null && (
        <TextField
          id="exercise-size"
          label={t.training.size(unitName(unit), local(String(smallest)), local(String(largest)))}
          value={size}
          numeric
        />
      )}
      <ActionButton act={act} disabled={Boolean(station.value?.run)}>
        {t.training.begin}
      </ActionButton>
    </div>
  );
}
