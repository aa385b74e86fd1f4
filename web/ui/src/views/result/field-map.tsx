/** One map of the workspace: colours, the limit as a line, fresh readings as dots, and the selected point. */
import { useRef } from "preact/hooks";
import { fixed } from "../../format";
import { t } from "../../messages";
import type { ErrorMap } from "../../types";
import type { Scale } from "./colours";
import { type Cell, cells, contour, type Grid, nearest, type Values } from "./field";

const MARGIN_MM = { left: 84, right: 30, top: 14, bottom: 46 };
const CROSS_MM = 12;

interface Props {
  name: string;
  grid: Grid;
  values: Values;
  scale: Scale;
  limit: number | null;
  dots?: ErrorMap["fresh"];
  cursor: Cell | null;
  read: (cell: Cell) => void;
}

export function FieldMap({ name, grid, values, scale, limit, dots = [], cursor, read }: Props) {
  const drawing = useRef<SVGSVGElement>(null);
  const [left, right] = [grid.x[0]!, grid.x.at(-1)!];
  const [low, high] = [grid.y[0]!, grid.y.at(-1)!];
  const line = limit === null ? "" : contour(grid, values, limit);
  const tapped = (event: MouseEvent) => {
    const toScreen = drawing.current?.getScreenCTM();
    if (!toScreen) return;
    const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(toScreen.inverse());
    read(nearest(grid, { x, y: -y }));
  };
  const [cx, cy] = cursor ? [grid.x[cursor.i]!, -grid.y[cursor.j]!] : [0, 0];
  return (
    <figure>
      <figcaption>{name}</figcaption>
      {/* the keys belong to the pair, which has the focus */}
      {/* biome-ignore lint/a11y/useKeyWithClickEvents: see above */}
      <svg
        ref={drawing}
        class="field-map"
        role="img"
        aria-label={name}
        viewBox={`${left - MARGIN_MM.left} ${-high - MARGIN_MM.top} ${right - left + MARGIN_MM.left + MARGIN_MM.right} ${high - low + MARGIN_MM.top + MARGIN_MM.bottom}`}
        onClick={tapped}
      >
        <rect class="area" x={left} y={-high} width={right - left} height={high - low} />
        {cells(grid, values, scale).map(({ fill, d }) => (
          <path key={fill} d={d} fill={fill} shape-rendering="crispEdges" />
        ))}
        {line && (
          <>
            <path class="limit under" d={line} />
            <path class="limit" d={line} />
          </>
        )}
        {dots.map(({ reading, x_mm, y_mm }) => (
          <circle key={reading} cx={x_mm} cy={-y_mm} r={5} />
        ))}
        {cursor && (
          <g class="cursor">
            <path class="under" d={cross(cx, cy)} />
            <path d={cross(cx, cy)} />
          </g>
        )}
        {(
          [
            ["start", left],
            ["middle", (left + right) / 2],
            ["end", right],
          ] as const
        ).map(([anchor, x]) => (
          <text key={anchor} x={x} y={-low + 18} text-anchor={anchor}>
            {fixed(x, 0)}
          </text>
        ))}
        <text x={(left + right) / 2} y={-low + 40} text-anchor="middle">
          {t.station.xAxis}
        </text>
        {[high, low].map((y) => (
          <text key={y} x={left - 8} y={-y + 5} text-anchor="end">
            {fixed(y, 0)}
          </text>
        ))}
        <text x={left - 8} y={-(high + low) / 2 + 5} text-anchor="end">
          {t.station.yAxis}
        </text>
      </svg>
    </figure>
  );
}

const cross = (x: number, y: number) =>
  `M${x - CROSS_MM} ${y}h${2 * CROSS_MM}M${x} ${y - CROSS_MM}v${2 * CROSS_MM}`;
