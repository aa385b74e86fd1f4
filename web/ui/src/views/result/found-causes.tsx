import { t } from "../../messages";
import type { Diagnosis } from "../../types";
import { Causes, Hints } from "../diagnosis/causes";
import { Experiments } from "../diagnosis/experiments";
import { MistakeInData } from "../diagnosis/mistake";
import { SeparatingOffer } from "../diagnosis/separating";

/** The findings of a diagnosis, in short; its own page has the charts. */
export function FoundCauses(props: {
  id: number;
  serial: string;
  found: Diagnosis | null;
  trouble: string | null;
}) {
  const { id, serial, found, trouble } = props;
  if (!found) return <p role="status">{trouble ?? t.shared.loading}</p>;
  return (
    <>
      <MistakeInData found={found} />
      <Causes found={found} />
      <Experiments found={found} />
      <SeparatingOffer id={id} serial={serial} found={found} />
      <Hints found={found} />
    </>
  );
}
