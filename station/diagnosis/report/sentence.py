"""The verdict of a diagnosis in one sentence: the only place where it is formulated."""

from __future__ import annotations

from collections.abc import Sequence

from station.diagnosis.traced_loop import TracedDiagnosis
from station.records import Reason, because


def verdict_reason(diagnosis: TracedDiagnosis, labels: Sequence[str]) -> Reason:
    """The reason for the verdict; `labels` of the effects found, strongest first."""
    d = diagnosis
    causes = " and ".join(labels)
    share = 100.0 * d.explained_share
    depends_on = d.hints[0].depends_on if d.hints else "nothing"
    confirmed = d.confirmed
    if d.alternative is not None and d.verdict in ("partly_explained", "unexplained"):
        return because("alternative", causes=causes, share_percent=share, alternative=d.alternative)
    match d.verdict:
        case "ambiguous":
            raise AssertionError("a search weighs no alternatives")
        case "adequate":
            return because("adequate_confirmed" if confirmed else "adequate")
        case "explained":
            code = "explained_confirmed" if confirmed else "explained"
            return because(code, causes=causes, share_percent=share)
        case "partly_explained" if confirmed is False:
            refusal = d.confirmations[-1].refusal
            return because(
                "partly_explained_refuted",
                causes=causes,
                share_percent=share,
                refusal=refusal,
                depends_on=depends_on,
            )
        case "partly_explained":
            code = "partly_explained_confirmed" if confirmed else "partly_explained"
            return because(code, causes=causes, share_percent=share, depends_on=depends_on)
    adequacy = d.trace.stages[-1].adequacy
    if not labels and adequacy.loud:
        return because("scattering", times=adequacy.loudness)
    if not labels and adequacy.passed:
        return because("adequate_refuted")
    if not labels:
        return because("unexplained", depends_on=depends_on)
    return because("unexplained_nearest", causes=causes, depends_on=depends_on)
