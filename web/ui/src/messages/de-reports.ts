/**
 * Messages that drives, lines, runs and the station produce in English only: `{name}` stands for any text,
 * `{name_text}` for whole sentences.
 */
export const reports: Record<string, string> = {
  // drives
  "Drive {unit} answered with exception {code}.": "Antrieb {unit} antwortete mit Ausnahme {code}.",
  "Drive {unit} does not know the function it was asked for (exception 01).":
    "Antrieb {unit} kennt die verlangte Funktion nicht (Ausnahme 01).",
  "Drive {unit} has no such register (exception 02); is it the configured model?":
    "Antrieb {unit} hat kein solches Register (Ausnahme 02); ist es das eingestellte Modell?",
  "Drive {unit} refuses the value or cannot take it now (exception 03).":
    "Antrieb {unit} lehnt den Wert ab oder kann ihn jetzt nicht annehmen (Ausnahme 03).",
  "Drive {unit} needs longer for its reply (exception 05).":
    "Antrieb {unit} braucht länger für seine Antwort (Ausnahme 05).",
  "Drive {unit} received a frame with a wrong check sum (exception 08); check the line.":
    "Antrieb {unit} empfing ein Telegramm mit falscher Prüfsumme (Ausnahme 08); prüfen Sie die Leitung.",
  "Drive {unit} does not answer the gateway (exception 0B); check cable, power and address.":
    "Antrieb {unit} antwortet dem Gateway nicht (Ausnahme 0B); prüfen Sie Kabel, Versorgung und Adresse.",
  "Drive {unit} was not given its command: a stop came first.":
    "Antrieb {unit} bekam seinen Befehl nicht: ein Stopp kam zuvor.",
  "Drive {unit} gave no proper reply on {address}: {what}; check the line for noise and double addresses.":
    "Antrieb {unit} antwortete auf {address} nicht richtig: {what}; prüfen Sie die Leitung auf Störungen und doppelte Adressen.",
  "Drive {unit} gave no proper reply on {address}: drive {other} answered {bytes}; check the gateway and the addresses.":
    "Antrieb {unit} antwortete auf {address} nicht richtig: Antrieb {other} antwortete {bytes}; prüfen Sie Gateway und Adressen.",
  "Drive {unit} does not answer on {address}; check cable, power and address.":
    "Antrieb {unit} antwortet auf {address} nicht; prüfen Sie Kabel, Versorgung und Adresse.",
  "The command came too late and was not carried out; look at the machine, then try again.":
    "Der Befehl kam zu spät und wurde nicht ausgeführt; sehen Sie nach der Maschine, dann versuchen Sie es noch einmal.",
  // lines
  "{address} answered {bytes}, which is not Modbus TCP; check the address and the gateway's mode.":
    "{address} antwortete {bytes}, und das ist kein Modbus TCP; prüfen Sie die Adresse und die Betriebsart des Gateways.",
  "{address} cannot carry {format} (a pseudo-terminal has neither parity nor 7 bits); add override=8N1 to its URL if that is intended.":
    "{address} kann {format} nicht übertragen (ein Pseudo-Terminal hat weder Parität noch 7 Bit); ergänzen Sie override=8N1 in der Adresse, wenn das so gemeint ist.",
  "{address} cannot be reached: {why}; check cable, power and address.":
    "{address} ist nicht erreichbar: {why}; prüfen Sie Kabel, Versorgung und Adresse.",
  "{address} cannot be opened: {why}; is it a device server with RFC 2217?":
    "{address} lässt sich nicht öffnen: {why}; ist es ein Geräteserver mit RFC 2217?",
  "{address} cannot be opened: {why}.": "{address} lässt sich nicht öffnen: {why}.",
  "{address} sends back what it is sent (echo): switch the echo of its adapter off, or add echo=1 to its address.":
    "{address} sendet zurück, was gesendet wird (Echo): Schalten Sie das Echo des Adapters ab, oder ergänzen Sie echo=1 in der Adresse.",
  "{address} broke while {doing}: {why}.": "{address} brach ab (beim {doing}): {why}.",
  "{address} echoed something else than it was sent; check the line.":
    "{address} gab ein anderes Echo zurück, als gesendet wurde; prüfen Sie die Leitung.",
  "{address} does not echo what it is sent, although its address says echo=1; remove that, or check the adapter.":
    "{address} gibt kein Echo zurück, obwohl die Adresse echo=1 enthält; entfernen Sie das, oder prüfen Sie den Adapter.",
  "{address} is not open; connect first.":
    "{address} ist nicht offen; stellen Sie zuerst die Verbindung her.",
  reading: "Lesen",
  writing: "Schreiben",
  "the far end closed the connection": "die Gegenstelle hat die Verbindung beendet",
  "nothing answers": "niemand antwortet",
  // scales
  "The {name} does not answer on {address}; check cable and power.":
    "{name} antwortet auf {address} nicht; prüfen Sie Kabel und Versorgung.",
  "The {name} does not answer on {address}; check cable, power and address.":
    "{name} antwortet auf {address} nicht; prüfen Sie Kabel, Versorgung und Adresse.",
  "The {name} answered {reply}, which is not a reply it may give; check the line.":
    "{name} antwortete {reply}, und diese Antwort gibt es nicht; prüfen Sie die Leitung.",
  "The {name} marks its value as faulty: {why}.": "{name} kennzeichnet den Wert als fehlerhaft: {why}.",
  "no error text is shown, look at head and cable":
    "es wird kein Fehlertext angezeigt, sehen Sie nach Abtastkopf und Kabel",
  "The {name} counts in inches; set it to mm.": "{name} zählt in Zoll; stellen Sie mm ein.",
  'The {name} shows the unit "{unit}"; set it to mm.':
    "{name} zeigt die Einheit „{unit}“; stellen Sie mm ein.",
  "The {name} has its sorting limits the wrong way round; correct them.":
    "Bei {name} sind die Sortiergrenzen vertauscht; berichtigen Sie sie.",
  "The {name} shows {series} instead of the present value; change its display.":
    "{name} zeigt {series} statt des augenblicklichen Werts; stellen Sie die Anzeige um.",
  "The {name} printed {printed} mm but shows {shown} mm; check its unit and display step, and that the head stands still.":
    "{name} sendete {printed} mm und zeigt {shown} mm; prüfen Sie Einheit und Anzeigeschritt, und ob der Abtastkopf stillsteht.",
  "The {name} refuses {command}; is it an ND 280, 281B or 287?":
    "{name} lehnt {command} ab; ist es ein ND 280, 281B oder 287?",
  "The {name} answered {counts} counts in a row; check the line for noise, and whether the head stands still.":
    "{name} antwortete nacheinander {counts} Schritte; prüfen Sie die Leitung auf Störungen, und ob der Abtastkopf stillsteht.",
  "The {name} refuses command {command}h (error {error}h); is it the configured model?":
    "{name} lehnt den Befehl {command}h ab (Fehler {error}h); ist es das eingestellte Modell?",
  "The {name} counts in {says}, the station file says resolution_mm = {resolution}; correct one of them.":
    "{name} zählt in {says}, in der Stationsdatei steht resolution_mm = {resolution}; berichtigen Sie eines von beiden.",
  "The {name} received a telegram with a wrong check byte; check the line.":
    "{name} empfing ein Telegramm mit falschem Prüfbyte; prüfen Sie die Leitung.",
  "The {name} cannot measure: its gap to the tape is too large, its position is implausible, or it moves faster than 5 m/s; look at head and tape.":
    "{name} kann nicht messen: Der Abstand zum Band ist zu groß, die Position nicht glaubhaft, oder die Bewegung schneller als 5 m/s; sehen Sie nach Abtastkopf und Band.",
  // axes
  "{axis} was asked to move to {angle}.": "{axis} sollte nach {angle} fahren.",
  "{axis} cannot be told {angle} deg; that is more pulses than it counts.":
    "{axis} kann nicht nach {angle}° geschickt werden; das sind mehr Impulse, als er zählt.",
  "{axis} was asked for {speed} deg/s; 0 to {most} is possible.":
    "{axis} sollte mit {speed} °/s fahren; möglich ist 0 bis {most}.",
  "{axis} shows alarm {alarm}h; find its cause, then reset it.":
    "{axis} meldet Alarm {alarm}h; suchen Sie die Ursache, dann setzen Sie ihn zurück.",
  "{axis} can only be declared to stand at {angle} deg, where its drive's zero is, not at {other} deg.":
    "Für {axis} kann nur {angle}° gesetzt werden, wo der Nullpunkt des Antriebs ist, nicht {other}°.",
  "{axis} is moving; its zero can be set at standstill only.":
    "{axis} bewegt sich; der Nullpunkt kann nur im Stillstand gesetzt werden.",
  "{axis} counts {pulses} pulses a turn, the station file says {counts}; correct one of them.":
    "{axis} zählt {pulses} Impulse je Umdrehung, in der Stationsdatei stehen {counts}; berichtigen Sie eines von beiden.",
  "{axis} counts {pulses} steps a turn, the station file says {counts}; correct one of them.":
    "{axis} zählt {pulses} Schritte je Umdrehung, in der Stationsdatei stehen {counts}; berichtigen Sie eines von beiden.",
  "{axis} is in control mode {mode}; set P00.01 to {wanted} (PR mode) and switch it off and on.":
    "{axis} ist in Regelart {mode}; setzen Sie P00.01 auf {wanted} (PR-Modus), und schalten Sie ihn aus und ein.",
  "{axis} has no output for servo-on; set one of P04.10 to P04.14 to {output}h.":
    "{axis} hat keinen Ausgang für „Servo ein“; setzen Sie einen von P04.10 bis P04.14 auf {output}h.",
  "{axis} is not switched on.": "{axis} ist nicht eingeschaltet.",
  "{axis} stands at {pulses} pulses after its zero was set; it was not taken.":
    "{axis} steht nach dem Setzen des Nullpunkts bei {pulses} Impulsen; er wurde nicht angenommen.",
  "{axis} does not switch on; check its power stage and safety input.":
    "{axis} schaltet nicht ein; prüfen Sie Leistungsteil und Sicherheitseingang.",
  "{axis} did not confirm its stop; use the emergency stop. {why_text}.":
    "{axis} bestätigte den Stopp nicht; benutzen Sie den Not-Halt. {why_text}.",
  "{axis} does not know its position; home it or preset it first.":
    "{axis} kennt seine Position nicht; referenzieren oder setzen Sie sie zuerst.",
  "{axis} has a communication watchdog of {set} ms instead of {wanted}.":
    "{axis} hat eine Kommunikationsüberwachung von {set} ms statt {wanted}.",
  // motion
  "Position {position} is refused: {why}.": "Position {position} wird abgelehnt: {why}.",
  "Position {position} is refused: joint {joint} would go to {angle} deg, {reach} deg about {zero} are allowed.":
    "Position {position} wird abgelehnt: Gelenk {joint} würde nach {angle}° fahren, erlaubt sind {reach}° um {zero}.",
  "The way to position {position} is refused: {why_text}.":
    "Der Weg zu Position {position} wird abgelehnt: {why_text}.",
  "The way to position {position} is refused: {why_text}":
    "Der Weg zu Position {position} wird abgelehnt: {why_text}",
  "({x}, {y}) mm is {excess} mm outside the workspace, {margin} mm is allowed":
    "({x}; {y}) mm liegt {excess} mm außerhalb des Arbeitsraums, erlaubt sind {margin} mm",
  "Reading {number} at position {position} does not settle: its samples spread {spread} mm, {allowed} mm is allowed.":
    "Messung {number} an Position {position} kommt nicht zur Ruhe: Ihre Einzelwerte streuen um {spread} mm, erlaubt sind {allowed} mm.",
  "Not ready to start. {why_text}.": "Nicht startbereit. {why_text}.",
  "{interlock}: {why_text}": "{interlock}: {why_text}",
  "At position {position} joint {joint} stands at {angle} deg instead of {wanted}.":
    "An Position {position} steht Gelenk {joint} bei {angle}° statt {wanted}.",
  "{axis} did not reach position {position} within {limit} s.":
    "{axis} erreichte Position {position} nicht innerhalb von {limit} s.",
  "{axis} shows alarm {alarm}h on the way to position {position}; find its cause, the next run resets it.":
    "{axis} meldet auf dem Weg zu Position {position} Alarm {alarm}h; suchen Sie die Ursache, der nächste Lauf setzt ihn zurück.",
  "{axis} lost its power on the way to position {position}.":
    "{axis} verlor auf dem Weg zu Position {position} die Versorgung.",
  "Joint {joint} left its way to position {position}: it is at {angle} deg.":
    "Gelenk {joint} hat seinen Weg zu Position {position} verlassen: Es ist bei {angle}°.",
  "On the way to position {position} the scale does not give a number.":
    "Auf dem Weg zu Position {position} liefert der Maßstab keine Zahl.",
  "Guard door, on the way to position {position}: {why}.":
    "Schutztür, auf dem Weg zu Position {position}: {why}.",
  "Temperature, on the way to position {position}: {why}.":
    "Temperatur, auf dem Weg zu Position {position}: {why}.",
  "Reading {number} at position {position} is not a number.":
    "Messung {number} an Position {position} ist keine Zahl.",
  "Reading {number} at position {position} is implausible: the scale shows {mm} mm as before, although the joints moved; check its display and rod.":
    "Messung {number} an Position {position} ist nicht glaubhaft: Der Maßstab zeigt {mm} mm wie zuvor, obwohl sich die Gelenke bewegt haben; prüfen Sie Anzeige und Stange.",
  "Reading {number} at position {position} is implausible: the scale moved {doubt} mm more than the joints say; check its rod and channel.":
    "Messung {number} an Position {position} ist nicht glaubhaft: Der Maßstab bewegte sich um {doubt} mm mehr, als die Gelenke sagen; prüfen Sie Stange und Kanal.",
  "Standstill could not be confirmed, look at the arm ({why}).":
    "Der Stillstand konnte nicht bestätigt werden, sehen Sie nach dem Arm ({why}).",
  "The zero of joint {joint} reads back {after} deg instead of {wanted}.":
    "Der Nullpunkt von Gelenk {joint} wird als {after}° statt {wanted} zurückgelesen.",
  "Whether joint {joint} took the zero of run {run} cannot be told any more; calibrate again.":
    "Es ist nicht mehr feststellbar, ob Gelenk {joint} den Nullpunkt von Lauf {run} angenommen hat; kalibrieren Sie neu.",
  "still moves": "bewegt sich noch",
  "no answer: {names}": "keine Antwort: {names}",
  "no reading": "kein Messwert",
  "its place is not known": "seine Position ist nicht bekannt",
  "{axis}: alarm {alarm}h; the next run tries to reset it":
    "{axis}: Alarm {alarm}h; der nächste Lauf versucht, ihn zurückzusetzen",
  "alarm {alarm}h": "Alarm {alarm}h",
  "not known while the drives do not answer": "nicht bekannt, solange die Antriebe nicht antworten",
  "input {bit} of unit {unit} says that it is open":
    "Eingang {bit} von Gerät {unit} meldet, dass sie offen ist",
  "the drives of this station are on no line with registers":
    "die Antriebe dieser Station hängen an keiner Leitung mit Registern",
  "it cannot be read: {why}": "lässt sich nicht lesen: {why}",
  "{shown} °C, {low} to {high} °C are allowed": "{shown} °C, erlaubt sind {low} bis {high} °C",
  "the checks of reference robot {robot} are not known yet":
    "die Prüfungen des Referenzroboters {robot} sind noch nicht bekannt",
  "reference robot {robot}: {why_text}": "Referenzroboter {robot}: {why_text}",
  "reference robot {robot} has not passed a check since it was calibrated":
    "Referenzroboter {robot} hat seit seiner Kalibrierung keine Prüfung bestanden",
  "the last check of reference robot {robot} was valid until {until} UTC":
    "die letzte Prüfung des Referenzroboters {robot} galt bis {until} UTC",
  // the return into the workspace
  "The arm still stands {mm} mm outside its workspace.":
    "Der Arm steht noch {mm} mm außerhalb seines Arbeitsraums.",
  "Step {number} of the way back led away from the workspace, from {before} mm to {after} mm outside; switch the drives off and look at the arm.":
    "Schritt {number} des Rückwegs führte vom Arbeitsraum weg, von {before} mm auf {after} mm außerhalb; schalten Sie die Antriebe ab, und sehen Sie nach dem Arm.",
  "No way back into the workspace is known from where the arm stands; switch the drives off and move it by hand.":
    "Von hier ist kein Rückweg in den Arbeitsraum bekannt; schalten Sie die Antriebe ab, und bewegen Sie den Arm von Hand.",
  "It is not known where the arm stands.": "Es ist nicht bekannt, wo der Arm steht.",
  "The linkage cannot close at these joint angles.":
    "Das Gelenkviereck kann sich bei diesen Gelenkwinkeln nicht schließen.",
  "The arm stands within its workspace.": "Der Arm steht in seinem Arbeitsraum.",
  "The arm stands {mm} mm outside its workspace.": "Der Arm steht {mm} mm außerhalb seines Arbeitsraums.",
  // prompts and steps of runs
  Measuring: "Messen",
  "Measuring, pass {number}": "Messen, Durchgang {number}",
  "Measuring, reading {number}": "Messen, Messung {number}",
  "Verifying at fresh positions": "Prüfen an neuen Positionen",
  Checking: "Prüfen",
  "Checking the machine": "Prüfen der Maschine",
  "Looking for the cause": "Suche nach der Ursache",
  "Confirming at fresh positions": "Bestätigen an neuen Positionen",
  "Distinguishing the causes": "Unterscheiden der Ursachen",
  "Measuring at the second mounting point": "Messen vom zweiten Anbauort",
  "Measuring at the first mounting point": "Messen vom ersten Anbauort",
  "Reading the level": "Ablesen der Neigungswaage",
  "Moving the mechanism": "Umsetzen der Messeinrichtung",
  "Moving the mechanism back": "Zurücksetzen der Messeinrichtung",
  "Mounting {number} of {all}": "Anbau {number} von {all}",
  "Operator {operator}, mounting {mounting}, calibration {number} of {all}":
    "Bediener {operator}, Anbau {mounting}, Kalibrierung {number} von {all}",
  "Put the level on the arm of joint {joint} and read its angle from the horizontal, positive when the elbow is higher. The drive says {angle} deg.":
    "Legen Sie die Neigungswaage auf den Arm von Gelenk {joint}, und lesen Sie seinen Winkel zur Waagerechten ab, positiv, wenn der Ellbogen höher liegt. Der Antrieb meldet {angle}°.",
  "Mount the mechanism at its second mounting point, ({x}, {y}) mm, then confirm.":
    "Bauen Sie die Messeinrichtung am zweiten Anbauort an, ({x}; {y}) mm, und bestätigen Sie dann.",
  "Mount the mechanism back at its first mounting point, ({x}, {y}) mm, then confirm.":
    "Bauen Sie die Messeinrichtung wieder am ersten Anbauort an, ({x}; {y}) mm, und bestätigen Sie dann.",
  "Operator {operator} of {operators}: take the mechanism off, mount it again at its mounting point as always, then confirm. Mounting {number} of {all}.":
    "Bediener {operator} von {operators}: Nehmen Sie die Messeinrichtung ab, bauen Sie sie wie immer an ihrem Anbauort wieder an, und bestätigen Sie dann. Anbau {number} von {all}.",
  "A number is asked for, in {unit}.": "Gefragt ist eine Zahl, in {unit}.",
  "{value} {unit} cannot be; between {low} and {high} is expected.":
    "{value} {unit} kann nicht sein; erwartet wird ein Wert zwischen {low} und {high}.",
  "Run {run} does not ask anything.": "Lauf {run} fragt nichts.",
  "Run {run} does not ask this (any more).": "Lauf {run} fragt das nicht (mehr).",
  // requirements of a run
  "Run {run} has no zero offsets; calibrate again.":
    "Lauf {run} hat keine Nullpunktfehler; kalibrieren Sie neu.",
  "Nothing was written: the machine is not as run {run} measured it. {why_text} Calibrate again.":
    "Es wurde nichts geschrieben: Die Maschine ist nicht so, wie Lauf {run} sie gemessen hat. {why_text} Kalibrieren Sie neu.",
  "{why_text} The old zero offsets are in the drives.": "{why_text} Die Antriebe haben die alten Nullpunkte.",
  "Nothing was written: the drives are not as they were left. {why_text} Calibrate again.":
    "Es wurde nichts geschrieben: Die Antriebe sind nicht so, wie sie verlassen wurden. {why_text} Kalibrieren Sie neu.",
  "{cause_text} The way back failed too: {why_text}": "{cause_text} Auch der Rückweg schlug fehl: {why_text}",
  "Robot {serial} has no passed calibration to be checked against; calibrate first.":
    "Roboter {serial} hat keine bestandene Kalibrierung, gegen die geprüft werden kann; kalibrieren Sie zuerst.",
  "Robot {serial} has no passed calibration.": "Roboter {serial} hat keine bestandene Kalibrierung.",
  "Run {run} has no error map: it identified no zero offsets.":
    "Lauf {run} hat keine Fehlerkarte: Er hat keine Nullpunktfehler bestimmt.",
  "Run {run} has no error map: its position error has no finite bound.":
    "Lauf {run} hat keine Fehlerkarte: Sein Positionsfehler hat keine endliche Schranke.",
  "Run {run} has no error map: no joint may be sent into the workspace.":
    "Lauf {run} hat keine Fehlerkarte: Kein Gelenk darf in den Arbeitsraum geschickt werden.",
  "Run {run} has no error map: {why_text}": "Lauf {run} hat keine Fehlerkarte: {why_text}",
  "Run {run} is no finished gauge study.": "Lauf {run} ist keine abgeschlossene Messsystemanalyse.",
  "Runs {first} and {run} differ in operators, mountings or repeats; evaluate them apart.":
    "Die Läufe {first} und {run} unterscheiden sich in Bedienern, Anbauten oder Wiederholungen; werten Sie sie getrennt aus.",
  "Robot {serial} is in two of these runs; give one study of each robot.":
    "Roboter {serial} kommt in zwei dieser Läufe vor; geben Sie von jedem Roboter eine Studie an.",
  "Run {run} is no gauge study; only a gauge study can go on.":
    "Lauf {run} ist keine Messsystemanalyse; nur eine Messsystemanalyse kann fortgesetzt werden.",
  "Run {run} is finished; start a new gauge study.":
    "Lauf {run} ist abgeschlossen; beginnen Sie eine neue Messsystemanalyse.",
  "The file of robot {serial} has changed since; start a new gauge study.":
    "Die Datei von Roboter {serial} hat sich seither geändert; beginnen Sie eine neue Messsystemanalyse.",
  "Run {run} has changed the drives' zeros since; start a new gauge study.":
    "Lauf {run} hat seither die Nullpunkte der Antriebe geändert; beginnen Sie eine neue Messsystemanalyse.",
  "{holds_text} Run {run} was made before it: calibrate again.":
    "{holds_text} Lauf {run} ist älter: Kalibrieren Sie neu.",
  "Nothing is locked for robot {serial}.": "Für Roboter {serial} ist nichts gesperrt.",
  "Not checked yet.": "Noch nicht geprüft.",
  "Check {run} passed.": "Prüfung {run} bestanden.",
  "Locked: check {run} failed. {why_text} An engineer can clear it.":
    "Gesperrt: Prüfung {run} nicht bestanden. {why_text} Ein Ingenieur kann die Sperre aufheben.",
  "Not known: {why_text}": "Nicht bekannt: {why_text}",
  "Run {run} {what}.": "Lauf {run} {what}.",
  "has no diagnosis whose explanations could be distinguished":
    "hat keine Diagnose, deren Erklärungen sich unterscheiden ließen",
  "The file of robot {serial} has changed since; find the cause again.":
    "Die Datei von Roboter {serial} hat sich seither geändert; suchen Sie die Ursache erneut.",
  "Run {run} has changed the drives' zeros since; find the cause again.":
    "Lauf {run} hat seither die Nullpunkte der Antriebe geändert; suchen Sie die Ursache erneut.",
  "Run {run} is not what the drives hold: {why_text} Taught positions are as they were.":
    "Die Antriebe haben nicht die Nullpunkte von Lauf {run}: {why_text} Die gelernten Positionen bleiben, wie sie waren.",
  "Run {run} is of robot {serial}, not {other}.": "Lauf {run} gehört zu Roboter {serial}, nicht {other}.",
  "Run {run} was never applied; nothing was taught under it.":
    "Lauf {run} wurde nie angewendet; unter ihm wurde nichts gelernt.",
  "The file of robot {serial} has changed since this run; calibrate again.":
    "Die Datei von Roboter {serial} hat sich seit diesem Lauf geändert; kalibrieren Sie neu.",
  "Run {run} has been applied by run {other}; calibrate to apply again.":
    "Lauf {run} wurde von Lauf {other} angewendet; kalibrieren Sie, um erneut anzuwenden.",
  "{state_text} There is nothing to roll back.": "{state_text} Es gibt nichts zurückzunehmen.",
  "Run {run} is no calibration; it belongs to run {other}.":
    "Lauf {run} ist keine Kalibrierung; er gehört zu Lauf {other}.",
  "Run {run} is of kind {kind}, not a calibration; calibrate to have offsets to write.":
    "Lauf {run} ist von der Art {kind}, keine Kalibrierung; kalibrieren Sie, um Nullpunkte zum Schreiben zu haben.",
  "Run {run} has not passed; only the offsets of a pass are written.":
    "Lauf {run} hat nicht bestanden; geschrieben werden nur Nullpunkte eines bestandenen Laufs.",
  "The zeros of the drives have been changed since, by run {run}.":
    "Die Nullpunkte der Antriebe wurden seither von Lauf {run} geändert.",
  "The readings do not determine the machine: {why_text}.":
    "Die Messungen bestimmen die Maschine nicht: {why_text}.",
  // taught positions
  "{source}: column {column} is missing; {columns} are needed.":
    "{source}: Die Spalte {column} fehlt; nötig sind {columns}.",
  "{source}: column {column} is given twice; leave one of them out.":
    "{source}: Die Spalte {column} ist zweimal angegeben; lassen Sie eine weg.",
  "{place}: column {column} needs a number (given: {value}).":
    "{place}: Die Spalte {column} braucht eine Zahl (angegeben: {value}).",
  "{source}: no positions.": "{source}: keine Positionen.",
  "{source}: line {line}: {name} has no angle of axis {axis}; both are needed.":
    "{source}: Zeile {line}: {name} hat keinen Winkel der Achse {axis}; beide sind nötig.",
  // the station
  "Run {run} holds the rig; wait for its end or abort it.":
    "Lauf {run} belegt die Station; warten Sie sein Ende ab, oder brechen Sie ihn ab.",
  "The station is shutting down; start it again first.":
    "Die Station fährt herunter; starten Sie sie zuerst neu.",
  "{kind} is not carried out on the rig.": "{kind} wird nicht an der Maschine ausgeführt.",
  "Robot {serial} does not fit this station's drives: joint {joint} has {what}; correct its [joints] or the station's [[servo.joint]].":
    "Roboter {serial} passt nicht zu den Antrieben dieser Station: Gelenk {joint} hat {what}; berichtigen Sie seine [joints] oder [[servo.joint]] der Station.",
  "There is no challenge {kind}; there is {kinds}.": "Die Aufgabe {kind} gibt es nicht; es gibt {kinds}.",
  "Give the joint, 1 or 2.": "Geben Sie das Gelenk an, 1 oder 2.",
  "The size must be {bounds}.": "Die Größe muss {bounds} sein.",
  "Run {run} is under way; wait for its end or abort it.":
    "Lauf {run} ist im Gange; warten Sie sein Ende ab, oder brechen Sie ihn ab.",
  "There is no exercise yet; choose a challenge first.":
    "Es gibt noch keine Übung; wählen Sie zuerst eine Aufgabe.",
  "An unseen exercise is under way; reveal it at the training desk first.":
    "Eine verdeckte Übung ist im Gange; decken Sie sie zuerst am Übungsplatz auf.",
  "The backup folder {folder} cannot be used: {why}.":
    "Der Sicherungsordner {folder} ist nicht benutzbar: {why}.",
  "The backup {target} cannot be written: {why}.":
    "Die Sicherung {target} lässt sich nicht schreiben: {why}.",
  "{target} exists already; a backup never overwrites.":
    "{target} gibt es schon; eine Sicherung überschreibt nie.",
  "The history cannot be used at this moment ({why}). Nothing was changed; try again.":
    "Der Verlauf ist im Augenblick nicht benutzbar ({why}). Es wurde nichts geändert; versuchen Sie es noch einmal.",
  "The service failed at this request; its log has the cause.":
    "Der Dienst scheiterte an dieser Anfrage; die Ursache steht in seinem Protokoll.",
  "The abort was sent but not confirmed; use the stop or the emergency stop.":
    "Der Abbruch wurde gesendet, aber nicht bestätigt; benutzen Sie den Stopp oder den Not-Halt.",
  "{name} has the role mes and may end only runs that it started; run {run} is not one. The stop is open to everyone.":
    "{name} hat die Rolle MES und darf nur selbst gestartete Läufe beenden; Lauf {run} ist keiner davon. Der Stopp steht jedem offen.",
  "The examination did not end within {limit} s; a device holds its line.":
    "Die Untersuchung endete nicht innerhalb von {limit} s; ein Gerät belegt seine Leitung.",
  "This station has real devices; faults can be ordered of the emulated ones only.":
    "Diese Station hat echte Geräte; Störungen kann man nur bei emulierten bestellen.",
  "This station has real devices; the training desk is for emulated ones only.":
    "Diese Station hat echte Geräte; der Übungsplatz ist nur für emulierte.",
  // the history
  "This idempotency key already belongs to run {run} with another request.":
    "Dieser Schlüssel gehört schon zu Lauf {run} mit einer anderen Anfrage.",
  "There is no delivery {id}.": "Es gibt keine Zustellung {id}.",
  "There is no user {name}.": "Es gibt keinen Benutzer {name}.",
  "There is no key {which}; `station key list` shows them.":
    "Es gibt keinen Schlüssel {which}; `station key list` zeigt sie.",
  "There is no key {which}.": "Es gibt keinen Schlüssel {which}.",
  "There is a user {name} already; choose another name.":
    "Einen Benutzer {name} gibt es schon; wählen Sie einen anderen Namen.",
  "{name} signs in with the plant's provider; a password or badge of the station would still open it after the provider has let the person go.":
    "{name} meldet sich über den Anbieter des Werks an; ein Kennwort oder Ausweis der Station würde sie noch öffnen, wenn der Anbieter die Person schon entlassen hat.",
  "Give another badge or PIN, or remove the badge; not both.":
    "Geben Sie einen anderen Ausweis oder eine andere PIN an, oder entfernen Sie den Ausweis; nicht beides.",
  "{name} has no PIN yet; give one with the badge.":
    "{name} hat noch keine PIN; geben Sie mit dem Ausweis eine an.",
  "{name} has no badge yet; give one with the PIN.":
    "{name} hat noch keinen Ausweis; geben Sie mit der PIN einen an.",
  "Another user has this badge; remove it there first.":
    "Ein anderer Benutzer hat diesen Ausweis; entfernen Sie ihn zuerst dort.",
  "Without the badge {name} has nothing to sign in with; give a password with it, or disable the user.":
    "Ohne den Ausweis kann sich {name} nicht anmelden; geben Sie zugleich ein Kennwort an, oder sperren Sie den Benutzer.",
  "There is a key {name} already; revoke it first or choose another name.":
    "Einen Schlüssel {name} gibt es schon; widerrufen Sie ihn zuerst, oder wählen Sie einen anderen Namen.",
  "The {source} is a machine of model {model}. Its logs can be imported and diagnosed; measuring, applying and solving are for five-bars.":
    "{source} ist eine Maschine des Modells {model}. Ihre Protokolle lassen sich importieren und diagnostizieren; Messen, Anwenden und Lösen gibt es für Fünfgelenke.",
  "Robot {serial} is not known here.": "Roboter {serial} ist hier nicht bekannt.",
  "There is no calibration {run}.": "Es gibt keine Kalibrierung {run}.",
  "Run {run} left no memory.": "Lauf {run} hat keine gespeicherten Parameter hinterlassen.",
  "Robot {serial} is said to be of type {type}, but robot {other} of that type has other nominal lengths; correct e, L and l or give it another type.":
    "Roboter {serial} soll vom Typ {type} sein, aber Roboter {other} dieses Typs hat andere Nennlängen; berichtigen Sie e, L und l, oder geben Sie ihm einen anderen Typ.",
  "Robot {serial} is kept as a machine of model {own}; give another kind of machine another serial number.":
    "Roboter {serial} ist als Maschine des Modells {own} gespeichert; geben Sie einer anderen Maschine eine andere Seriennummer.",
  "The cursor {cursor} is not one that a page gave.": "Die Marke {cursor} hat keine Seite ausgegeben.",
  "Run {run} has no diagnosis.": "Lauf {run} hat keine Diagnose.",
  "No wire log of run {run} is kept here.": "Von Lauf {run} ist hier kein Leitungsprotokoll gespeichert.",
  "{name} is no query parameter of this address; {there}.":
    "{name} ist kein Parameter dieser Adresse; {there}.",
  "Run {run} was made from the log of an arm; readings.csv is that log as it was.":
    "Lauf {run} entstand aus dem Protokoll eines Arms; readings.csv ist dieses Protokoll, wie es war.",
  // certificates
  "Run {run} has not ended; its certificate can be made after that.":
    "Lauf {run} ist nicht zu Ende; danach lässt sich sein Zertifikat ausstellen.",
  "Run {run} has no verdict on a robot, so there is nothing to certify.":
    "Lauf {run} hat kein Urteil über einen Roboter, also gibt es nichts zu bescheinigen.",
  "Run {run} was made from the log of an arm, measured elsewhere; this station cannot certify it.":
    "Lauf {run} entstand aus dem anderswo gemessenen Protokoll eines Arms; diese Station kann ihn nicht bescheinigen.",
  "The record of run {run} is not as it ended: nothing is certified. `station verify` says more.":
    "Die Aufzeichnung von Lauf {run} ist nicht mehr, wie sie war: Es wird nichts bescheinigt. Mehr sagt `station verify`.",
  // people
  "Sign in, or send an API key in the header `Authorization: Bearer KEY`.": "Melden Sie sich an.",
  "The session has ended; sign in again.": "Die Sitzung ist beendet; melden Sie sich wieder an.",
  "This API key is not known here.": "Dieser API-Schlüssel ist hier nicht bekannt.",
  "This API key ({name}) was revoked at {at} UTC.":
    "Dieser API-Schlüssel ({name}) wurde am {at} UTC widerrufen.",
  "This API key ({name}) expired at {at} UTC.": "Dieser API-Schlüssel ({name}) ist am {at} UTC abgelaufen.",
  "This needs the role {roles}; {name} has the role {role}.":
    "Das erfordert die Rolle {roles}; {name} hat die Rolle {role}.",
  "Name or password is wrong.": "Name oder Kennwort ist falsch.",
  "Badge or PIN is wrong.": "Ausweis oder PIN ist falsch.",
  "Too many failed sign-ins; wait {seconds} s.":
    "Zu viele fehlgeschlagene Anmeldungen; warten Sie {seconds} s.",
  "There is an administrator already, who can add users.":
    "Es gibt bereits einen Administrator, der Benutzer anlegen kann.",
  "This link was used already or is not this station's; start it again.":
    "Dieser Link wurde schon benutzt oder gehört nicht zu dieser Station; starten Sie sie neu.",
  "A badge needs a PIN, and a PIN a badge; give both or none.":
    "Ein Ausweis braucht eine PIN, und eine PIN einen Ausweis; geben Sie beides an oder keines.",
  "Give a password, or a badge and its PIN, to sign in with.":
    "Geben Sie zum Anmelden ein Kennwort an, oder einen Ausweis und seine PIN.",
  "Give name and password, or badge and PIN.": "Geben Sie Name und Kennwort an, oder Ausweis und PIN.",
  "{name} is the last administrator who can sign in; make another one first.":
    "{name} ist der letzte Administrator, der sich anmelden kann; legen Sie zuerst einen anderen an.",
  "A password has {fewest} to {most} characters.": "Ein Kennwort hat {fewest} bis {most} Zeichen.",
  "A PIN has {fewest} digits or more.": "Eine PIN hat {fewest} Ziffern oder mehr.",
  "The station file has no [openid]; sign in with name and password.":
    "Die Stationsdatei hat kein [openid]; melden Sie sich mit Name und Kennwort an.",
  "{what} has {count} characters; use 1 to {most}.": "{what} hat {count} Zeichen; erlaubt sind 1 bis {most}.",
  "{what} holds full-width or otherwise special letters; use plain ones.":
    "{what} enthält besondere Buchstaben; benutzen Sie gewöhnliche.",
  "{what} mixes letters of {scripts}; use those of one script.":
    "{what} mischt Buchstaben von {scripts}; benutzen Sie die einer Schrift.",
  "{what} has a part of nothing or of dots alone between slashes; name each part.":
    "{what} hat zwischen Schrägstrichen einen leeren Teil oder nur Punkte; benennen Sie jeden Teil.",
  "{what} holds {character}; use letters, digits 0 to 9 and {between}.":
    "{what} enthält {character}; benutzen Sie Buchstaben, Ziffern 0 bis 9 und {between}.",
  "Name {name} holds the control character {character}; leave it out.":
    "Name {name} enthält das Steuerzeichen {character}; lassen Sie es weg.",
  "Serial {serial}": "Seriennummer {serial}",
  // references and readings
  "Reference {what} has a standard uncertainty of {sd} {unit}; {least} to {most} {unit} is believed. Check the value and its unit.":
    "Die Referenz {what} hat eine Standardunsicherheit von {sd} {unit}; geglaubt werden {least} bis {most} {unit}. Prüfen Sie den Wert und seine Einheit.",
  "Reference {what} is {size} {unit} from what the robot file expects; at most {most} {unit} is believed. Check the value, its sign and the robot file.":
    "Referenz {what} liegt {size} {unit} neben dem, was die Roboterdatei erwarten lässt; geglaubt werden höchstens {most} {unit}. Prüfen Sie den Wert, sein Vorzeichen und die Roboterdatei.",
  "Readings {names} disagree with the rest, more than a tenth of {readings}; measure again and check the scale and its mounting.":
    "Die Messungen {names} widersprechen den übrigen, mehr als ein Zehntel von {readings}; messen Sie noch einmal, und prüfen Sie Maßstab und Anbau.",
  "Reading {reading}, columns theta1_deg and theta2_deg: {why_text} Check unit, sign and order of the joints and the robot file.":
    "Messung {reading}, Spalten theta1_deg und theta2_deg: {why_text} Prüfen Sie Einheit, Vorzeichen und Reihenfolge der Gelenke und die Roboterdatei.",
  "Reading {reading}, columns theta1_deg and theta2_deg: the angles look like radians; give degrees.":
    "Messung {reading}, Spalten theta1_deg und theta2_deg: Die Winkel sehen nach Radiant aus; geben Sie Grad an.",
  "Reading {reading}, column theta{joint}_deg: {angle} deg is beyond what the workspace needs, joint {number} from {low} to {high} deg. Check unit, sign and order of the joints and the robot file.":
    "Messung {reading}, Spalte theta{joint}_deg: {angle}° liegt außerhalb dessen, was der Arbeitsraum braucht, Gelenk {number} von {low} bis {high}°. Prüfen Sie Einheit, Vorzeichen und Reihenfolge der Gelenke und die Roboterdatei.",
  "Only {count} different places were measured; at least {fewest} are needed (paper, section 5).":
    "Es wurden nur {count} verschiedene Positionen gemessen; nötig sind mindestens {fewest} (Veröffentlichung, Abschnitt 5).",
  "Reading {reading}, column scale_mm: the distance is {off} mm off what its joint angles say, compared with the other readings; check that the row is in its place.":
    "Messung {reading}, Spalte scale_mm: Der Abstand weicht um {off} mm von dem ab, was die Gelenkwinkel im Vergleich mit den anderen Messungen sagen; prüfen Sie, ob die Zeile an ihrer Stelle steht.",
  "Impossible result: {what}; check the robot file and the readings' columns, then run the diagnosis.":
    "Unmögliches Ergebnis: {what}; prüfen Sie die Roboterdatei und die Spalten der Messungen, dann starten Sie die Diagnose.",
  "Only {count} numbers were measured for {unknown} unknowns without a tolerance; measure more poses.":
    "Es wurden nur {count} Zahlen für {unknown} Unbekannte ohne Toleranz gemessen; messen Sie mehr Stellungen.",
  "The identification cannot start: {why_text}; check the robot file and that angles and readings belong together.":
    "Die Bestimmung kann nicht beginnen: {why_text}; prüfen Sie die Roboterdatei, und ob Winkel und Messungen zusammengehören.",
  "The identification did not converge ({why}); check that angles and distances belong together.":
    "Die Bestimmung konvergierte nicht ({why}); prüfen Sie, ob Winkel und Abstände zusammengehören.",
  "The workspace needs {needed} mm of the scale's {travel} mm travel; check [workspace] and [mechanism] in the robot file.":
    "Der Arbeitsraum braucht {needed} mm der {travel} mm Messlänge des Maßstabs; prüfen Sie [workspace] und [mechanism] in der Roboterdatei.",
  "Not enough data to judge: {what} are needed.": "Zu wenig Daten für ein Urteil: Nötig sind {what}.",
  "Only {count} fresh readings; at least {fewest} are needed to confirm.":
    "Nur {count} neue Messungen; zum Bestätigen sind mindestens {fewest} nötig.",
  "The fresh readings are of {what} {which}, which the measurement sequence never used.":
    "Die neuen Messungen sind von {what} {which}, das die Messfolge nie benutzt hat.",
  // bodies of requests
  "Input holds characters that cannot be here, or lacks some that must":
    "Die Eingabe enthält Zeichen, die hier nicht stehen dürfen, oder es fehlen nötige",
  "{field}: {why_text}": "{field}: {why_text}",
  "Input should be greater than {limit}": "Die Eingabe muss größer als {limit} sein",
  "Input should be greater than or equal to {limit}": "Die Eingabe muss mindestens {limit} sein",
  "Input should be less than {limit}": "Die Eingabe muss kleiner als {limit} sein",
  "Input should be less than or equal to {limit}": "Die Eingabe darf höchstens {limit} sein",
  "String should have at least {count} character": "Nötig ist mindestens {count} Zeichen",
  "String should have at least {count} characters": "Nötig sind mindestens {count} Zeichen",
  "String should have at most {count} characters": "Erlaubt sind höchstens {count} Zeichen",
  "Field required": "Angabe fehlt",
  "Input should be a valid number": "Die Eingabe muss eine Zahl sein",
  robot_serial: "Seriennummer des Roboters",
  operator: "Bediener",
  // the examination of the devices
  "{name}, emulated": "{name}, emuliert",
  "{name} at {address}": "{name} an {address}",
  "connects within {ms} ms": "verbindet sich in {ms} ms",
  "held by {names} too": "auch von {names} belegt",
  "end that program; two that read one port take each other's bytes":
    "beenden Sie jenes Programm; zwei an einem Anschluss nehmen einander Bytes weg",
  "names its adapter; it is {port} at present": "nennt seinen Adapter; zurzeit ist es {port}",
  "its adapter is {name}": "sein Adapter ist {name}",
  "name it {name} in the station file: {port} may be another one after plugging":
    "nennen Sie ihn in der Stationsdatei {name}: {port} kann nach dem Umstecken ein anderer sein",
  "has no name under {folder}": "hat keinen Namen unter {folder}",
  "its adapter has no serial number; a udev rule can name it by its socket":
    "sein Adapter hat keine Seriennummer; eine udev-Regel kann ihn nach seiner Buchse benennen",
  "check that the gateway is switched on, its network address and its port":
    "prüfen Sie, ob das Gateway eingeschaltet ist, seine Netzadresse und seinen Port",
  "adapters there are: {names}": "vorhandene Adapter: {names}",
  "this device was there and failed: look at its line for noise":
    "dieses Gerät war da und fiel aus: Sehen Sie nach Störungen auf seiner Leitung",
  "shows alarm {alarm}h": "meldet Alarm {alarm}h",
  "find its cause in the maker's manual; the next run resets it":
    "suchen Sie die Ursache im Handbuch des Herstellers; der nächste Lauf setzt ihn zurück",
  "moves, although this program moves nothing": "bewegt sich, obwohl dieses Programm nichts bewegt",
  "find out who moves it": "stellen Sie fest, wer ihn bewegt",
  "is powered": "ist bestromt",
  "stands {mm} mm outside its workspace": "steht {mm} mm außerhalb seines Arbeitsraums",
  "cannot stand where the drives say: the linkage does not close":
    "kann nicht stehen, wo die Antriebe sagen: Die Glieder schließen sich nicht",
  "{where}; with the drives exchanged it would be within":
    "{where}; mit vertauschten Antrieben wäre er darin",
  "compare with the arm; if it stands elsewhere, exchange the units of the two [[servo.joint]]":
    "vergleichen Sie mit dem Arm; steht er woanders, vertauschen Sie die Adressen der beiden [[servo.joint]]",
  "compare with the arm; `station retract` brings it back":
    "vergleichen Sie mit dem Arm; „Zurückholen“ bringt ihn zurück",
  "exchange the two addresses in the station file, or the plugs":
    "vertauschen Sie die beiden Adressen in der Stationsdatei oder die Stecker",
  "if that is not so, check [interlocks.{id}] in the station file":
    "wenn das nicht so ist, prüfen Sie [interlocks.{id}] in der Stationsdatei",
  "{text} ({limits})": "{text} ({limits})",
  "{text} ({limits}): {shows}": "{text} ({limits}): {shows}",
  "at most {value} mm": "höchstens {value} mm",
  "at most {value} °": "höchstens {value}°",
  "{low} to {high} °C": "{low} bis {high} °C",
  "All devices answer": "Alle Geräte antworten",
  "Both drives are ready": "Beide Antriebe sind bereit",
  "The arm stands within its workspace": "Der Arm steht in seinem Arbeitsraum",
  "The scale reads": "Der Maßstab liefert Werte",
  "The scale moves as far as the joints say": "Der Maßstab bewegt sich so weit wie die Gelenke",
  "Each joint keeps to its way": "Jedes Gelenk bleibt auf seinem Weg",
  "The guard door is closed": "Die Schutztür ist geschlossen",
  "The temperature is within its window": "Die Temperatur liegt im erlaubten Bereich",
  "The reference check is valid": "Die Referenzprüfung gilt",
  // wire traffic
  "drive {unit}: {address}h {name} = {value}": "{value} (Register {address}h)",
  "drive {unit}: {address}h = {value}": "{value} (Register {address}h)",
  "drive {unit}: {address}h {name} on = {bytes}": "{name} und folgende = {bytes} (Register {address}h)",
  "drive {unit}: {address}h on = {bytes}": "Register {address}h und folgende = {bytes}",
  "drive {unit}: done": "ausgeführt",
  "drive {unit}: refuses with exception {code}": "lehnt ab, Ausnahme {code}",
  "drive {unit}: read {what}": "Antrieb {unit}: {what} lesen",
  "drive {unit}: write {what}": "Antrieb {unit}: {what} schreiben",
  "drive {unit}: function {code}h, {bytes}": "Antrieb {unit}: Funktion {code}h, {bytes}",
  "bytes {bytes}": "Bytes {bytes}",
  "{name} and {count} more": "{name} und {count} weitere",
  "what is the value?": "Welcher Wert?",
  "the value is {value}": "der Wert ist {value}",
  "the value is {value}, marked as faulty": "der Wert ist {value}, als fehlerhaft gekennzeichnet",
  "resume sending (XON)": "weiter senden (XON)",
  "head {head}: {command} = {value}": "Abtastkopf {head}: {command} = {value}",
  "head {head}: {command}": "Abtastkopf {head}: {command}",
  "pulses a turn": "Impulse je Umdrehung",
  "switch on": "Einschalten",
  "motion status": "Bewegungszustand",
  alarm: "Alarm",
  "alarm reset": "Alarm zurücksetzen",
  trigger: "Auslösen",
  "position, pulses": "Position, Impulse",
  "path 0: mode, target, speed, ramps, pause, trigger":
    "Fahrsatz 0: Art, Ziel, Geschwindigkeit, Rampen, Pause, Auslösen",
  "target of path 0, pulses": "Ziel von Fahrsatz 0, Impulse",
  "control mode": "Regelart",
  "function of input {number}": "Funktion von Eingang {number}",
  "function of output {number}": "Funktion von Ausgang {number}",
  outputs: "Ausgänge",
  inputs: "Eingänge",
  "direct data: number, type, position, speed, ramps, torque, trigger":
    "Direktdaten: Nummer, Art, Position, Geschwindigkeit, Rampen, Drehmoment, Auslösen",
  "position of the direct data, steps": "Position der Direktdaten, Schritte",
  "position, steps": "Position, Schritte",
  "position preset": "Position setzen",
  resolution: "Auflösung",
  "communication watchdog, ms": "Kommunikationsüberwachung, ms",
  "On the way to position {position} the scale moved {doubt} mm beside what the joints say; check its rod and channel.":
    "Auf dem Weg zu Position {position} bewegte sich der Maßstab um {doubt} mm anders, als die Gelenke sagen; prüfen Sie Stange und Kanal.",
  "While position {position} was read, joint {joint} came to stand at {angle} deg instead of {wanted}; has its drive restarted?":
    "Während an Position {position} gemessen wurde, kam Gelenk {joint} bei {angle}° statt {wanted} zu stehen; ist sein Antrieb neu gestartet?",
  position: "Position",
  "type and firmware": "Typ und Firmware",
  "received a wrong check byte": "empfing ein falsches Prüfbyte",
  "refuses, or cannot measure": "lehnt ab oder kann nicht messen",
  "refuses the value": "lehnt den Wert ab",
  "identifies itself as {identity}": "meldet sich als {identity}",
  "{axis} counts {numerator}/{denominator} steps a turn, the station file says {counts}; correct one of them.":
    "{axis} zählt {numerator}/{denominator} Schritte je Umdrehung, in der Stationsdatei stehen {counts}; berichtigen Sie eines von beiden.",
  "{format}, in place of {wanted}": "{format} statt {wanted}",
  "remove override= unless the port is emulated":
    "entfernen Sie override=, wenn der Anschluss nicht emuliert ist",
  "its adapter sends back what it is sent, as echo=1 says":
    "sein Adapter sendet zurück, was gesendet wird, wie echo=1 sagt",
  "{axis} has lost its power during this run and may count from elsewhere: no zero is written; calibrate again.":
    "{axis} war während dieses Laufs stromlos und zählt vielleicht von woanders: Es wird kein Nullpunkt geschrieben; kalibrieren Sie neu.",
  // receivers of events
  "nothing accepts connections there": "dort nimmt nichts Verbindungen an",
  "the connection was closed before the answer was complete":
    "die Verbindung wurde vor dem Ende der Antwort geschlossen",
  "there is no way to that computer in the network": "im Netzwerk führt kein Weg zu diesem Rechner",
  "the disk is full": "der Datenträger ist voll",
  "the station may not write there": "die Station darf dort nicht schreiben",
  "the folder is a file": "der Ordner ist eine Datei",
  "its certificate is not accepted: {reason}": "sein Zertifikat wird nicht anerkannt: {reason}",
  "no encrypted connection could be made": "es kam keine verschlüsselte Verbindung zustande",
  "no computer of that name is known": "kein Rechner dieses Namens ist bekannt",
  "no answer within the time limit": "keine Antwort innerhalb der Zeitgrenze",
  "answered {status}": "antwortete {status}",
  "no connection to the broker": "keine Verbindung zum Broker",
  "the broker did not acknowledge": "der Broker hat nicht bestätigt",
  "the broker answers: {reason}": "der Broker antwortet: {reason}",
  "the broker refuses the connection: {reason}": "der Broker lehnt die Verbindung ab: {reason}",
  acknowledged: "bestätigt",
};
