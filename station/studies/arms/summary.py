"""What the logs show, as figures."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from station.studies.arms.one import Judged


def figures(found: Sequence[Judged]) -> dict[str, object]:
    """Counts over all logs and by kind; tracebacks and refusals word for word."""
    kinds = sorted({one.kind for one in found})
    return {
        "logs": len(found),
        "tracebacks": sorted(one.traceback for one in found if one.traceback),
        "refused": dict(Counter(one.refused for one in found if one.refused).most_common()),
        "confirmed": sum(one.confirmed for one in found),
        "confirmed_without_support": sum(one.unsupported for one in found),
        "kinds": {kind: _of_kind([one for one in found if one.kind == kind]) for kind in kinds},
    }


def _of_kind(found: Sequence[Judged]) -> dict[str, object]:
    return {
        "logs": len(found),
        "verdicts": dict(sorted(Counter(one.verdict or "refused" for one in found).items())),
        "right_joint": sum(bool(one.named) and one.named <= one.joints for one in found),
        "wrong_joint": sum(not one.named <= one.joints for one in found),
    }
