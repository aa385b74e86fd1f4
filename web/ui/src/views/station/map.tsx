/**
 * The workspace from above the table: planned, completed and next positions, and the position of the robot.
 */
import { fixed } from "../../format";
import { station } from "../../live";
import { t } from "../../messages";
import type { Run, RunStop } from "../../types";

const MARGIN_MM = { left: 66, right: 30, top: 10, bottom: 30 };
/** With more positions than this, they are drawn smaller. */
const CROWDED = 12;

export function WorkspaceMap({ run }: { run: Run | null }) {
  const workspace = station.value?.workspace;
  if (!workspace)
    return <svg class="map" viewBox="-306 622 576 190" role="img" aria-label={t.station.mapUnknown} />;
  const [left, right] = workspace.x;
  const [bottom, top] = workspace.y;
  const width = right - left;
  const height = top - bottom;
  const positions = positionsOf(run?.stops ?? []);
  const next = run?.stops.find((stop) => !stop.done)?.position;
  const radius = positions.length > CROWDED ? 5 : 7;
  const done = positions.filter((position) => position.class === "done").length;
  const machine = station.value?.machine;
  return (
    <svg
      class="map"
      role="img"
      aria-label={t.station.map(done, positions.length)}
      // y grows upwards in the robot's frame and downwards on the screen
      viewBox={`${left - MARGIN_MM.left} ${-top - MARGIN_MM.top} ${width + MARGIN_MM.left + MARGIN_MM.right} ${height + MARGIN_MM.top + MARGIN_MM.bottom}`}
    >
      <rect class="area" x={left} y={-top} width={width} height={height} />
      <line class="axis" x1={0} x2={0} y1={-top} y2={-bottom} />
      {[left, 0, right].map((x) => (
        <text key={x} x={x} y={-bottom + 25} text-anchor="middle">
          {fixed(x, 0)}
        </text>
      ))}
      <text x={(left + right) / 2 + 60} y={-bottom + 25} text-anchor="middle">
        {t.station.xAxis}
      </text>
      {[top, bottom].map((y) => (
        <text key={y} x={left - 16} y={-y + 4} text-anchor="end">
          {fixed(y, 0)}
        </text>
      ))}
      <text x={left - 16} y={-(top + bottom) / 2 + 4} text-anchor="end">
        {t.station.yAxis}
      </text>
      {positions.map((position) => (
        <g key={position.position} class={position.class}>
          {position.position === next && (
            <circle class="ring" cx={position.x_mm} cy={-position.y_mm} r={radius + 6} />
          )}
          <circle cx={position.x_mm} cy={-position.y_mm} r={radius} />
        </g>
      ))}
      {machine?.x_mm != null && machine.y_mm != null && (
        <path
          class="machine"
          d={`M${machine.x_mm - 11},${-machine.y_mm}h22M${machine.x_mm},${-machine.y_mm - 11}v22`}
        />
      )}
    </svg>
  );
}

/** The meaning of its marks; beside the drawing, where each language has enough space. */
export function MapKey() {
  return (
    <ul class="map-key" aria-hidden="true">
      {(["done", "partly", "planned"] as const).map((mark) => (
        <li key={mark}>
          <svg class="map" viewBox="-6 -6 12 12">
            <g class={mark}>
              <circle r={4} />
            </g>
          </svg>
          {t.station[mark]}
        </li>
      ))}
      <li>
        <svg class="map" viewBox="-6 -6 12 12">
          <path class="machine" d="M-5,0h10M0,-5v10" />
        </svg>
        {t.station.robot}
      </li>
    </ul>
  );
}

/** One mark for each position: stops that share one are repeats of it. */
function positionsOf(stops: RunStop[]) {
  const repeats = new Map<string, RunStop[]>();
  for (const stop of stops) repeats.set(stop.position, [...(repeats.get(stop.position) ?? []), stop]);
  return [...repeats.values()].map((visits) => {
    const done = visits.filter((visit) => visit.done).length;
    return { ...visits[0]!, class: done === visits.length ? "done" : done > 0 ? "partly" : "to-come" };
  });
}
