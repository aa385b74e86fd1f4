/** The maintenance of the station, one part at a time; the address contains which. */
import { station } from "../../live";
import { t } from "../../messages";
import { Link } from "../../parts/link";
import { query } from "../../router";
import { AuditPart } from "./audit";
import { BackupsPart } from "./backups";
import { DeliveriesPart } from "./deliveries";
import { DevicesPart } from "./devices";
import { PeoplePart } from "./people";
import { TrainingPart } from "./training";
import { VersionsPart } from "./versions";
import { WirePart } from "./wire";

const PARTS = [
  { id: "devices", name: t.maintenance.devicesPart, Part: DevicesPart },
  { id: "wire", name: t.maintenance.wirePart, Part: WirePart },
  { id: "deliveries", name: t.maintenance.deliveriesPart, Part: DeliveriesPart },
  { id: "backups", name: t.maintenance.backupsPart, Part: BackupsPart },
  { id: "people", name: t.maintenance.peoplePart, Part: PeoplePart },
  { id: "audit", name: t.maintenance.auditPart, Part: AuditPart },
  { id: "versions", name: t.maintenance.versionsPart, Part: VersionsPart },
];
const TRAINING = { id: "training", name: t.maintenance.trainingPart, Part: TrainingPart };

export function MaintenanceView() {
  // real devices have no training desk
  const parts = station.value?.station.emulated ? [...PARTS, TRAINING] : PARTS;
  const wanted = query.value.get("part");
  const shown = parts.find(({ id }) => id === wanted) ?? parts[0]!;
  return (
    <div class="maintenance">
      <h1 class="hidden">{t.maintenance.title}</h1>
      <nav class="parts" aria-label={t.maintenance.parts}>
        {parts.map(({ id, name }) => (
          <Link key={id} to={`/maintenance?part=${id}`} current={id === shown.id}>
            {name}
          </Link>
        ))}
      </nav>
      <shown.Part key={shown.id} />
    </div>
  );
}
