/** The workspace from above the table: positions to come, done and next, and where the robot stands. */
import type { Run, RunStop } from "../../api";
import { fixed } from "../../format";
import { station } from "../../live";

const MARGIN_MM = { left: 66, right: 30, top: 24, bottom: 30 };
/** More places than this are drawn smaller. */
const CROWDED = 12;

export function WorkspaceMap({ run }: { run: Run | null }) {
  const workspace = station.value?.workspace;
  if (!workspace) return <svg class="map" viewBox="-306 608 576 204" role="img" aria-label="Workspace, not known yet" />;
  const [left, right] = workspace.x;
  const [bottom, top] = workspace.y;
  const width = right - left;
  const height = top - bottom;
  const places = placesOf(run?.stops ?? []);
  const next = run?.stops.find((stop) => !stop.done)?.position;
  const radius = places.length > CROWDED ? 5 : 7;
  const done = places.filter((place) => place.class === "done").length;
  const machine = station.value?.machine;
  return (
    <svg
      class="map"
      role="img"
      aria-label={`Workspace: ${done} of ${places.length} positions of this pass done`}
      // y grows upwards in the robot's frame and downwards on the screen
      viewBox={`${left - MARGIN_MM.left} ${-top - MARGIN_MM.top} ${width + MARGIN_MM.left + MARGIN_MM.right} ${height + MARGIN_MM.top + MARGIN_MM.bottom}`}
    >
      <rect class="area" x={left} y={-top} width={width} height={height} />
      <line class="axis" x1={0} x2={0} y1={-top} y2={-bottom} />
      {[left, 0, right].map((x) => (
        <text x={x} y={-bottom + 25} text-anchor="middle">
          {fixed(x, 0)}
        </text>
      ))}
      <text x={(left + right) / 2 + 60} y={-bottom + 25} text-anchor="middle">
        x, mm
      </text>
      {[top, bottom].map((y) => (
        <text x={left - 16} y={-y + 4} text-anchor="end">
          {fixed(y, 0)}
        </text>
      ))}
      <text x={left - 16} y={-(top + bottom) / 2 + 4} text-anchor="end">
        y, mm
      </text>
      {places.map((place) => (
        <g key={place.position} class={place.class}>
          {place.position === next && <circle class="ring" cx={place.x_mm} cy={-place.y_mm} r={radius + 6} />}
          <circle cx={place.x_mm} cy={-place.y_mm} r={radius} />
        </g>
      ))}
      {machine?.x_mm != null && machine.y_mm != null && (
        <path class="machine" d={`M${machine.x_mm - 11},${-machine.y_mm}h22M${machine.x_mm},${-machine.y_mm - 11}v22`} />
      )}
      <g class="key" transform={`translate(${right - 236} ${-top - 12})`}>
        <g class="done">
          <circle cx={0} cy={-4} r={4} />
        </g>
        <text x={8}>done</text>
        <g class="partly">
          <circle cx={50} cy={-4} r={4} />
        </g>
        <text x={58}>partly</text>
        <g class="to-come">
          <circle cx={104} cy={-4} r={4} />
        </g>
        <text x={112}>to come</text>
        <path class="machine" d="M168,-4h10M173,-9v10" />
        <text x={182}>robot now</text>
      </g>
    </svg>
  );
}

/** One mark for each place: stops that share a position are repeats of it. */
function placesOf(stops: RunStop[]) {
  const repeats = Map.groupBy(stops, (stop) => stop.position);
  return [...repeats.values()].map((visits) => {
    const done = visits.filter((visit) => visit.done).length;
    return { ...visits[0]!, class: done === visits.length ? "done" : done > 0 ? "partly" : "to-come" };
  });
}
