"""The decision by itself: every way to a verdict, and which stage is trusted."""

from __future__ import annotations

import pytest

from station.diagnosis.decision import GOOD_SHARE, Decision, StageFigures, decide

LOST = StageFigures(adequate=False, fit_ratio=25.0)
FITS = StageFigures(adequate=True, fit_ratio=1.0)


def fresh(stage: StageFigures, confirmed: bool, rms_mm: float, ratio: float = 1.0) -> StageFigures:
    return StageFigures(stage.adequate, stage.fit_ratio, confirmed, rms_mm, ratio)


@pytest.mark.parametrize(
    ("stages", "alternative", "share", "verdict", "passed", "outcome"),
    [
        ([FITS], False, 0.0, "adequate", True, "not_verified"),
        ([fresh(FITS, True, 0.001)], False, 0.0, "adequate", True, "good"),
        ([fresh(FITS, False, 0.01)], False, 0.0, "unexplained", False, "unexplained"),
        ([LOST], False, 0.0, "unexplained", False, "unexplained"),
        ([LOST, FITS], False, 0.95, "explained", True, "not_verified"),
        ([fresh(LOST, False, 0.02), fresh(FITS, True, 0.001)], False, 0.95, "explained", True, "repair"),
        (
            [fresh(LOST, False, 0.02), fresh(FITS, False, 0.01)],
            False,
            0.95,
            "partly_explained",
            False,
            "unexplained",
        ),
        ([LOST, FITS], True, 0.95, "partly_explained", False, "unexplained"),
        ([LOST, FITS], True, GOOD_SHARE / 2, "unexplained", False, "unexplained"),
        ([LOST, LOST], False, GOOD_SHARE, "partly_explained", False, "unexplained"),
        ([LOST, LOST], False, GOOD_SHARE - 1e-9, "unexplained", False, "unexplained"),
    ],
)
def test_verdicts(
    stages: list[StageFigures], alternative: bool, share: float, verdict: str, passed: bool, outcome: str
) -> None:
    found = decide(stages, alternative=alternative, share=share)
    assert (found.verdict, found.passed, found.outcome) == (verdict, passed, outcome)


@pytest.mark.parametrize(
    ("stages", "share", "verdict", "confirmed"),
    [
        ([fresh(LOST, True, 0.02)], 0.0, "unexplained", False),
        ([fresh(LOST, True, 0.02), fresh(LOST, True, 0.018)], 0.2, "unexplained", False),
        ([LOST], 0.0, "unexplained", None),
        ([fresh(LOST, True, 0.02), fresh(LOST, True, 0.005)], 0.9, "partly_explained", True),
        ([fresh(FITS, True, 0.001)], 0.0, "adequate", True),
    ],
)
def test_nothing_confirms_what_is_unexplained(
    stages: list[StageFigures], share: float, verdict: str, confirmed: bool | None
) -> None:
    found = decide(stages, alternative=False, share=share)
    assert (found.verdict, found.confirmed) == (verdict, confirmed)


def test_the_last_stage_is_trusted_unless_it_is_contradicted() -> None:
    assert decide([LOST, FITS], alternative=False, share=0.9).trusted == 1
    assert decide([LOST, LOST], alternative=False, share=0.1).trusted == 0
    contradicted = [fresh(LOST, False, 0.02), fresh(LOST, False, 0.005), fresh(FITS, False, 0.01)]
    assert decide(contradicted, alternative=False, share=0.9).trusted == 1
    confirmed = [fresh(LOST, False, 0.001), fresh(FITS, True, 0.002)]
    assert decide(confirmed, alternative=False, share=0.9).trusted == 1


def test_what_does_not_fit_or_predict_is_less_certain() -> None:
    assert decide([FITS], alternative=False, share=0.0).sd_factor == 1.0
    assert decide([LOST], alternative=False, share=0.0).sd_factor == 5.0
    wild = [fresh(FITS, False, 0.01, ratio=36.0)]
    assert decide(wild, alternative=False, share=0.0).sd_factor == 6.0
    both = [fresh(LOST, False, 0.01, ratio=4.0)]
    assert decide(both, alternative=False, share=0.0).sd_factor == 5.0
    predicted = [fresh(FITS, True, 0.01, ratio=36.0)]
    assert decide(predicted, alternative=False, share=0.0).sd_factor == 1.0


@pytest.mark.parametrize(
    ("verdict", "confirmed", "refuted"),
    [
        ("adequate", None, False),
        ("explained", True, False),
        ("partly_explained", None, False),
        ("partly_explained", True, False),
        ("partly_explained", False, True),
        ("unexplained", None, True),
    ],
)
def test_effects_that_are_no_more_than_an_attempt(
    verdict: str, confirmed: bool | None, refuted: bool
) -> None:
    assert Decision(verdict, confirmed, 0, 1.0).refuted is refuted  # type: ignore[arg-type]
