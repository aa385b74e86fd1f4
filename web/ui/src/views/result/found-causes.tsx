import { diagnosis } from "../../api";
import { t } from "../../messages";
import { useLoaded } from "../../parts/load";
import { Causes, Hints } from "../diagnosis/causes";
import { Experiments } from "../diagnosis/experiments";
import { MistakeInData } from "../diagnosis/mistake";
import { SeparatingOffer } from "../diagnosis/separating";

/** What a diagnosis found, in short; its own page has the charts. */
export function FoundCauses({ id, serial }: { id: number; serial: string }) {
  const { value: found, trouble } = useLoaded(`${id}`, () => diagnosis(id)).value;
  if (!found) {
    return (
      <section class="panel wide">
        <p role="status">{trouble ?? t.shared.loading}</p>
      </section>
    );
  }
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
