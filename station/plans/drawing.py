"""A plan as a drawing: positions for a terminal, positions and predicted accuracy for a page."""

from __future__ import annotations

from collections import Counter

from station.five_bar import Robot
from station.plans.plan import Plan
from station.report import Chart, Page, Section, Table, place_map

COLUMNS, ROWS = 61, 13
STOP_COLUMNS = ("stop", "position", "x mm", "y mm", "theta1 deg", "theta2 deg", "approach")


def plan_as_text(plan: Plan, robot: Robot) -> str:
    """The workspace as a frame of characters, each position as the number of its readings."""
    (x0, x1), (y0, y1) = robot.workspace_x, robot.workspace_y
    cells = [[" "] * COLUMNS for _ in range(ROWS)]
    for (x, y), count in readings_at(plan).items():
        column = round((x - x0) / (x1 - x0) * (COLUMNS - 1))
        row = round((y1 - y) / (y1 - y0) * (ROWS - 1))
        cells[row][column] = str(count) if count < 10 else "+"
    frame = "+" + "-" * COLUMNS + "+"
    lines = [frame, *("|" + "".join(row) + "|" for row in cells), frame]
    lines[1] += f" y = {y1:g} mm"
    lines[-2] += f" y = {y0:g} mm"
    ends = f"x = {x0:g} mm"
    return "\n".join([*lines, ends + f"{x1:g} mm".rjust(COLUMNS + 2 - len(ends))])


def readings_at(plan: Plan) -> Counter[tuple[float, float]]:
    """Number of readings at each position."""
    return Counter(stop.target_mm for stop in plan.stops)


def stop_rows(plan: Plan) -> list[tuple[str, ...]]:
    """The stops in their order, by `STOP_COLUMNS`."""
    return [
        (
            str(k),
            stop.position,
            *(f"{v:.1f}" for v in stop.target_mm),
            *(f"{v:.4f}" for v in stop.theta_deg),
            " ".join(f"{a:+d}" if a else "any" for a in stop.approach),
        )
        for k, stop in enumerate(plan.stops, start=1)
    ]


def plan_page(plan: Plan) -> Page:
    """Positions, order and predicted accuracy as a self-contained page."""
    at = readings_at(plan)
    field = plan.predicted.map
    return Page(
        title=f"Plan {plan.name}",
        lead=plan.summary(),
        sections=[
            Section(
                heading="Places",
                charts=[
                    Chart(
                        place_map([x for x, _ in at], [y for _, y in at], list(at.values()), "readings"),
                        "Where P is measured; the discs' area is the number of readings.",
                    )
                ],
            ),
            Section(
                heading="Predicted position error",
                charts=[
                    Chart(
                        place_map(
                            [p.x_mm for p in field],
                            [p.y_mm for p in field],
                            [p.sd_mm for p in field],
                            "mm",
                        ),
                        "Standard deviation of P after a calibration with this plan.",
                    )
                ],
            ),
            Section(
                heading="Order",
                tables=[
                    Table(STOP_COLUMNS, stop_rows(plan)),
                ],
            ),
        ],
    )
