/** Sentences that the station produces in English only: numbers are {}, in order. */
export const sentences: Record<string, string> = {
  // zeros in the drives
  "The drives hold the old zero offsets.": "Die Antriebe haben die alten Nullpunkte.",
  "The drives hold these zero offsets.": "Die Antriebe haben diese Nullpunkte.",
  "One drive holds its new zero offset, the other does not.":
    "Ein Antrieb hat seinen neuen Nullpunkt, der andere nicht.",
  "It is unknown whether a drive accepted its new zero. The next run will check.":
    "Es ist unbekannt, ob ein Antrieb seinen neuen Nullpunkt angenommen hat. Der nächste Lauf prüft es.",
  "The zeros of the drives have been changed since, for another run.":
    "Die Nullpunkte der Antriebe wurden seither für einen anderen Lauf geändert.",
  "Rolled back: the drives hold the old zero offsets again.":
    "Zurückgenommen: Die Antriebe haben wieder die alten Nullpunkte.",
  // the examination of the devices
  "answers: {} replies, {} ms as a rule, {} ms the slowest":
    "antwortet: {} Antworten, in der Regel nach {} ms, die langsamste nach {} ms",
  "reads {} mm": "zeigt {} mm",
  "stands at {} deg": "steht bei {}°",
  "is not powered; a run powers it": "ist nicht bestromt; ein Lauf bestromt ihn",
  "the arm": "der Arm",
  "stands within its workspace": "steht in seinem Arbeitsraum",
  interlocks: "Verriegelungen",
};
