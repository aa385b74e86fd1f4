/** The workspace from above the table: positions to come, done and next, and where the robot stands. */
import type { Run } from "../api";
import { station } from "../live";

const MARGIN_MM = 34;

export function WorkspaceMap({ run }: { run: Run | null }) {
  const workspace = station.value?.workspace;
  if (!workspace) return <svg class="map" viewBox="-274 598 548 218" role="img" aria-label="Workspace, not known yet" />;
  const [left, right] = workspace.x;
  const [bottom, top] = workspace.y;
  const width = right - left;
  const height = top - bottom;
  const stops = run?.stops ?? [];
  const next = stops.findIndex((stop) => !stop.done);
  const done = stops.filter((stop) => stop.done).length;
  const machine = station.value?.machine;
  return (
    <svg
      class="map"
      role="img"
      aria-label={`Workspace: ${done} of ${stops.length} positions of this pass done`}
      // y grows upwards in the robot's frame and downwards on the screen
      viewBox={`${left - MARGIN_MM} ${-top - MARGIN_MM / 2} ${width + 2 * MARGIN_MM} ${height + 1.5 * MARGIN_MM}`}
    >
      <rect class="area" x={left} y={-top} width={width} height={height} />
      <line class="axis" x1={0} x2={0} y1={-top} y2={-bottom} />
      <text x={left} y={-bottom + 17} text-anchor="middle">{`x ${left}`}</text>
      <text x={0} y={-bottom + 17} text-anchor="middle">
        0 mm
      </text>
      <text x={right} y={-bottom + 17} text-anchor="middle">
        {right}
      </text>
      <text x={left + 4} y={-top + 13}>{`y ${top}`}</text>
      <text x={left + 4} y={-bottom - 5}>{`${bottom} mm`}</text>
      {stops.map((stop, i) => (
        <g class={stop.done ? "done" : i === next ? "next" : "to-come"}>
          {i === next && <circle class="ring" cx={stop.x_mm} cy={-stop.y_mm} r={13} />}
          <circle cx={stop.x_mm} cy={-stop.y_mm} r={7} />
        </g>
      ))}
      {machine?.x_mm != null && machine.y_mm != null && (
        <path class="machine" d={`M${machine.x_mm - 11},${-machine.y_mm}h22M${machine.x_mm},${-machine.y_mm - 11}v22`} />
      )}
      <g class="key" transform={`translate(${right - 196} ${-top - 6})`}>
        <g class="done">
          <circle cx={0} cy={-4} r={4} />
        </g>
        <text x={8}>done</text>
        <g class="to-come">
          <circle cx={48} cy={-4} r={4} />
        </g>
        <text x={56}>to come</text>
        <path class="machine" d="M108,-4h10M113,-9v10" />
        <text x={123}>robot now</text>
      </g>
    </svg>
  );
}
