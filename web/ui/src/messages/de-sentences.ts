/** Sentences that the station says in English only: numbers are {}, in their order. */
export const sentences: Record<string, string> = {
  // what the drives hold
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
  // why an adaptive plan ended
  "the plan has ended": "der Plan ist zu Ende",
  "the most readings are taken": "mehr Messungen sind nicht vorgesehen",
  "the wanted accuracy is reached": "die gewünschte Genauigkeit ist erreicht",
  "readings cannot reach the wanted accuracy":
    "mit Messungen ist die gewünschte Genauigkeit nicht zu erreichen",
  "further readings would not help": "weitere Messungen würden nicht helfen",
  // what earlier calibrations found
  "geometry and mechanism as earlier calibrations found them":
    "Geometrie und Messeinrichtung, wie frühere Kalibrierungen sie fanden",
  "not used: it contradicts the new readings; has the mechanism been remounted?":
    "nicht benutzt, denn sie widersprechen den neuen Messungen; wurde die Messeinrichtung neu angebaut?",
  // the weakest direction
  "both arms together": "beide Arme gemeinsam",
  "one arm against the other": "ein Arm gegen den anderen",
  "both arms together with a sideways error of the mechanism":
    "beide Arme gemeinsam mit einem seitlichen Anbaufehler der Messeinrichtung",
  "one arm against the other with a sideways error of the mechanism":
    "ein Arm gegen den anderen mit einem seitlichen Anbaufehler der Messeinrichtung",
  "both arms together with an error of the mechanism along its height":
    "beide Arme gemeinsam mit einem Anbaufehler der Messeinrichtung in der Höhe",
  "one arm against the other with an error of the mechanism along its height":
    "ein Arm gegen den anderen mit einem Anbaufehler der Messeinrichtung in der Höhe",
  "measure the mechanism's mounting error to {} mm (sd {} deg)":
    "Messen Sie den Anbaufehler der Messeinrichtung auf {} mm genau (Standardunsicherheit dann {}°)",
  "repeat the sequence with the mechanism mounted {} mm aside (sd {} deg)":
    "Wiederholen Sie die Messfolge mit der Messeinrichtung {} mm weiter seitlich (Standardunsicherheit dann {}°)",
  // remedies
  "Adjust or replace the reducer, or approach every position from the same side.":
    "Stellen Sie das Getriebe nach, ersetzen Sie es, oder fahren Sie jede Position von derselben Seite an.",
  "Align the guide rods; check that nothing forces the scale.":
    "Richten Sie die Führungsstangen aus; prüfen Sie, dass nichts den Maßstab verspannt.",
  "Check the head's coupling and the friction of the slider.":
    "Prüfen Sie die Kupplung des Abtastkopfs und die Reibung des Schlittens.",
  "Check the mounting of head and scale and the readout's supply, then measure again.":
    "Prüfen Sie den Anbau von Abtastkopf und Maßstab und die Versorgung der Anzeige, und messen Sie dann noch einmal.",
  "Check the reducer stage that turns n times a joint turn, or keep the term in the model.":
    "Prüfen Sie die Getriebestufe, die sich je Gelenkumdrehung n-mal dreht, oder behalten Sie den Term im Modell.",
  "Clean and realign the head; check what has this period (graduation, rolling element, screw).":
    "Reinigen Sie den Abtastkopf und richten Sie ihn neu aus; prüfen Sie, was diese Periode hat (Teilung, Wälzkörper, Spindel).",
  "Correct the drive's ratio or pulses per turn.":
    "Berichtigen Sie die Übersetzung oder die Impulse je Umdrehung im Antrieb.",
  "Let readout and machine warm up; check the mounting of scale and base.":
    "Lassen Sie Anzeige und Maschine warm werden; prüfen Sie den Anbau von Maßstab und Gestell.",
  "Let the machine warm up before it is measured; check the mounting of scale and mechanism.":
    "Lassen Sie die Maschine vor dem Messen warm werden; prüfen Sie den Anbau von Maßstab und Messeinrichtung.",
  "Measure the link; correct the robot file or replace the link.":
    "Messen Sie das Glied nach; berichtigen Sie die Roboterdatei, oder ersetzen Sie das Glied.",
  "No entry of the catalogue has this shape; look at the residual, and at what moves with it.":
    "Kein Eintrag des Katalogs hat diese Form; sehen Sie sich den Restfehler an, und was sich mit ihm ändert.",
  "Re-centre or replace the encoder, or keep the term in the controller's model.":
    "Zentrieren oder ersetzen Sie den Drehgeber, oder behalten Sie den Term im Modell der Steuerung.",
  "Replace the bearing of the passive joint.": "Ersetzen Sie das Lager des passiven Gelenks.",
  "Set the readout's linear compensation, or replace the scale.":
    "Stellen Sie die lineare Korrektur der Anzeige ein, oder ersetzen Sie den Maßstab.",
  "Stiffen the drive train or compensate for the torque in the controller.":
    "Versteifen Sie den Antriebsstrang, oder gleichen Sie das Drehmoment in der Steuerung aus.",
  "The same is seen where `[joints] ratio` or `counts_per_rev` is wrong: check both.":
    "Dasselbe zeigt sich, wo `[joints] ratio` oder `counts_per_rev` falsch ist: Prüfen Sie beide.",
  "The same is seen where the readout has a wrong factor: check its setting.":
    "Dasselbe zeigt sich, wo die Anzeige einen falschen Faktor hat: Prüfen Sie ihre Einstellung.",
  "The same is seen where the robot file has a wrong length: compare it with the drawing.":
    "Dasselbe zeigt sich, wo die Roboterdatei eine falsche Länge hat: Vergleichen Sie sie mit der Zeichnung.",
  "Tighten coupling or belt, check the encoder cable, then calibrate again.":
    "Ziehen Sie Kupplung oder Riemen nach, prüfen Sie das Kabel des Drehgebers, und kalibrieren Sie dann neu.",
  "Warm up before calibrating, or compensate for the recorded temperature.":
    "Lassen Sie die Maschine vor dem Kalibrieren warm werden, oder gleichen Sie die aufgezeichnete Temperatur aus.",
  // what distinguishes one effect from others
  "Compare the scale with a gauge block or an interferometer.":
    "Vergleichen Sie den Maßstab mit einem Endmaß oder einem Interferometer.",
  "Compare the scale with an interferometer over its travel.":
    "Vergleichen Sie den Maßstab über seinen Weg mit einem Interferometer.",
  "Measure again with something changed: the payload, the mounting point, the speed.":
    "Messen Sie noch einmal, und ändern Sie dabei etwas: die Last, den Anbauort, die Geschwindigkeit.",
  "Measure the link, or repeat the sequence from a second mount of the mechanism.":
    "Messen Sie das Glied nach, oder wiederholen Sie die Messfolge von einem zweiten Anbauort der Messeinrichtung.",
  "Reach the same position once with the slider moving up and once moving down.":
    "Fahren Sie dieselbe Position einmal mit steigendem und einmal mit sinkendem Schlitten an.",
  "Read finely over two or three periods of the joint angle.":
    "Messen Sie fein über zwei oder drei Perioden des Gelenkwinkels.",
  "Read finely over two or three periods of travel, or start at another point of the scale.":
    "Messen Sie fein über zwei oder drei Perioden des Wegs, oder beginnen Sie an einer anderen Stelle des Maßstabs.",
  "Read over a wider range of the joint, or from a second mount of the mechanism.":
    "Messen Sie über einen größeren Bereich des Gelenks, oder von einem zweiten Anbauort der Messeinrichtung.",
  "Read the first positions again: the step stays, at every position alike.":
    "Messen Sie die ersten Positionen noch einmal: Der Sprung bleibt, an jeder Position gleich.",
  "Read the first positions again: the step stays.":
    "Messen Sie die ersten Positionen noch einmal: Der Sprung bleibt.",
  "Read the same positions from the other side.": "Messen Sie dieselben Positionen von der anderen Seite.",
  "Repeat the measurement sequence warm, with the temperature recorded.":
    "Wiederholen Sie die Messfolge bei warmer Maschine, und zeichnen Sie die Temperatur auf.",
  "Repeat the measurement sequence with a payload on the platform.":
    "Wiederholen Sie die Messfolge mit einer Last auf der Plattform.",
  "Repeat the measurement sequence with the load on the platform reversed.":
    "Wiederholen Sie die Messfolge mit umgekehrter Last auf der Plattform.",
  "Stand still at one position and read for as long as the measurement sequence took.":
    "Bleiben Sie an einer Position stehen, und messen Sie so lange, wie die Messfolge gedauert hat.",
  "Turn the joint through its whole range against an inclinometer.":
    "Drehen Sie das Gelenk durch seinen ganzen Bereich, und vergleichen Sie es mit einer Neigungswaage.",
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
