/** The versions that a fault report should contain. */
import { t } from "../../messages";
import { useLoaded } from "../../parts/load";
import { Pending } from "./action";
import { versions } from "./calls";

export function VersionsPart() {
  const m = t.maintenance;
  const { value, trouble } = useLoaded("", versions).value;
  if (!value) return <Pending trouble={trouble} />;
  const rows: [string, string][] = [
    [m.program, value.program],
    [m.pageBuild, value.page],
    [m.schema, value.schema_step.replaceAll("_", " ")],
    [m.diagnosisVersion, value.diagnosis],
    ["Python", value.python],
    [m.system, value.system],
    ...Object.entries(value.libraries),
  ];
  return (
    <section class="panel part" aria-labelledby="versions-title">
      <h2 id="versions-title">{m.versions}</h2>
      <dl class="pairs">
        {rows.map(([name, version]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{version}</dd>
          </div>
        ))}
      </dl>
    </section>
  );
}
