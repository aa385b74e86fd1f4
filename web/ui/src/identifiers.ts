/** Values of reasons and phrases that are identifiers, by their name in the templates. */
import { t } from "./messages";
import { dependence, inSentence, labelsInSentence, parameter, planOf } from "./names";

const parameters = (ids: string) => t.listed(ids.split(", ").map((id) => inSentence(parameter(id).name)));

const IDENTIFIERS: Record<string, (value: string) => string> = {
  alternative: dependence,
  causes: labelsInSentence,
  depends_on: dependence,
  looks_like: parameters,
  parameter: parameters,
  plan: (id) => planOf(id)?.name ?? id,
  unnamed: labelsInSentence,
};

/** The display name of an identifier; undefined for a value that is none. */
export const identified = (name: string, value: string): string | undefined =>
  Object.hasOwn(IDENTIFIERS, name) ? IDENTIFIERS[name]!(value) : undefined;
