"""Usual names of the columns of an arm's log, in several languages, and which columns belong together."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

_JOINT = re.compile(
    r"joint|theta|θ|axis|axe|achse|gelenk|articul|eje|giunt|asse|关节|轴|軸|関節|motor|servo|angle|winkel|angulo|ángulo|"
    r"position(?=\[\d)|(^|[^a-z])[qja](?=[_ ]?\d)",
    re.IGNORECASE,
)
_NOT_AN_ANGLE = re.compile(
    r"vel|speed|geschw|vitesse|cur|strom|torq|moment|tau|acc|beschl|temp|volt|power|load|qd|"
    r"std|dev|dif|err|sigma|abw",
    re.IGNORECASE,
)
_COMMANDED = re.compile(
    r"target|command|cmd|soll|goal|desired|nominal|consigne|theor|teor|目标|指令|_t($|[_ \[(])", re.IGNORECASE
)
_MEASURED = re.compile(
    r"act|meas|mess|(^|[^a-z])ist|[xyz]ist|feedback|tracker|mesur|medid|misur|real|实测|实际|测量",
    re.IGNORECASE,
)
_DEVIATION = re.compile(r"dif|dev|err|delta|abw|écart|ecart|偏差", re.IGNORECASE)
_SPREAD = re.compile(r"std|sigma|uncert|rms|(^|[_ ])sd($|[_ ])|unsich", re.IGNORECASE)
_TURN = re.compile(r"rot|roll|orient|quat|euler|(^|[_ ])r[_ ]?[xyz]($|[_ ])", re.IGNORECASE)
_NUMBERED = re.compile(r"(.*?)(\d+)(\D*)")
_AXES = (
    re.compile(r"(?:^|(?<=[^A-Za-z]))(?:p|pos)?([xyz])(?=$|[^A-Za-z])", re.IGNORECASE),
    re.compile(r"(?<=[a-z])([XYZ])(?=$|[^A-Za-z])"),
    re.compile(r"^([xyz])(?=ist|soll|act|meas|mess|mes|nom)", re.IGNORECASE),
)
UR_JOINTS = ("shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3")
"""From the base on: ROS messages list them in alphabetical order."""
TIME = re.compile(
    r"^(t|t_s|time|zeit|temps|tiempo|tempo|date|datum|seconds|时间|時間)($|[^a-z0-9])|stamp|stempel", re.I
)
TEMPERATURE = re.compile(r"temp(?!(s|o)($|[^a-z]))|温度", re.I)
DISTANCE = re.compile(r"range|dist|abstand|entfern|strecke|距离", re.I)


def joint_columns(names: Sequence[str]) -> list[list[str]]:
    """Groups of columns that may be the joint angles, most likely first."""
    groups = [group for group in _by_number(names) if len(group) > 1 and _is_angle(group[0])]
    spelled = [name for name in names if re.search(r"_joint|joint$", name, re.I) and _is_angle(name)]
    if len(spelled) > max((len(group) for group in groups), default=1):
        groups = [group for group in groups if not set(group) & set(spelled)] + [_from_the_base(spelled)]
    return sorted(groups, key=lambda group: (_standing(group[0]), -len(group)))


def _from_the_base(names: list[str]) -> list[str]:
    order = {name: i for name in names for i, part in enumerate(UR_JOINTS) if part in name.lower()}
    return sorted(names, key=lambda name: order[name]) if len(order) == len(names) else names


def point_columns(names: Sequence[str]) -> dict[str, list[str]]:
    """Columns x, y and z that belong together, by their names without the axis."""
    parts: dict[str, dict[str, str]] = {}
    for name in names:
        found = next((match for axis in _AXES if (match := axis.search(name))), None)
        if found is not None and not _TURN.search(name) and not _SPREAD.search(name):
            stem = name[: found.start(1)] + "*" + name[found.end(1) :]
            parts.setdefault(stem, {})[found.group(1).lower()] = name
    return {stem: [axes[a] for a in "xyz"] for stem, axes in parts.items() if len(axes) == 3}


def of_one_kind(stems: Iterable[str]) -> list[str]:
    """Stems that differ only in a number, in its order: points that were measured in turn."""
    groups = sorted(_by_number(list(stems)), key=len, reverse=True)
    return groups[0] if groups and len(groups[0]) > 1 else []


def is_deviation(name: str) -> bool:
    """Whether a column contains a deviation."""
    return _DEVIATION.search(name) is not None


def is_commanded(name: str) -> bool:
    """Whether a column contains a commanded value."""
    return _COMMANDED.search(name) is not None and not is_deviation(name)


def is_measured(name: str) -> bool:
    """Whether the name of a column indicates a measured value."""
    return _MEASURED.search(name) is not None


def matrix_columns(names: Sequence[str]) -> list[str]:
    """12 or 16 columns that may be a pose matrix, in the order of the file."""
    groups = [group for group in _by_number(names, in_order=False) if len(group) in (12, 16)]
    return groups[0] if groups else []


def _is_angle(name: str) -> bool:
    return _JOINT.search(name) is not None and _NOT_AN_ANGLE.search(name) is None


def _standing(name: str) -> int:
    return 0 if is_measured(name) else 2 if is_commanded(name) else 1


def _by_number(names: Sequence[str], *, in_order: bool = True) -> list[list[str]]:
    """Names that differ only in their last number, by that number."""
    groups: dict[tuple[str, str], list[tuple[int, str]]] = {}
    for name in names:
        if match := _NUMBERED.fullmatch(name):
            groups.setdefault((match.group(1).lower(), match.group(3).lower()), []).append(
                (int(match.group(2)), name)
            )
    return [[name for _, name in (sorted(group) if in_order else group)] for group in groups.values()]
