"""What is said of emulated machines: clean, roughly disturbed, a natural pair, and outside the catalogue."""

from __future__ import annotations

import numpy as np
import pytest

from station.diagnosis.explanations import ExplanationSet, explain
from station.diagnosis.explanations.mixture import FORM
from station.diagnosis.explanations.validation import together
from station.five_bar.mechanism import FiveBar
from station.studies.confusion.machines import draw
from tests.station.diagnosis.explanations.problems import ROBOT, TRUTH, effect, measured


def explained(seed: int, *effects: tuple[tuple[str, object], ...]) -> ExplanationSet:
    sequence, fresh = measured(seed, *effects)
    return explain(FiveBar(ROBOT, sequence), fresh)


def within(found: ExplanationSet, sds: float) -> bool:
    """Whether both zero offsets are right."""
    return all(
        abs(q.value - np.degrees(true)) < sds * q.sd
        for q, true in zip(found.parameters[:2], TRUTH[:2], strict=True)
    )


def test_nothing_is_blamed_on_a_clean_machine() -> None:
    found = explained(1)
    assert found.decision.verdict == "adequate"
    assert found.decision.confirmed is True
    assert found.findings == ()
    assert found.statements.base > 0.9
    assert within(found, 3.0)
    assert max(q.sd for q in found.parameters[:2]) < 0.045


def test_probabilities_sum_to_one() -> None:
    found = explained(1, effect(kind="drift", mm_per_hour=1.0))
    assert sum(p for _, p in found.statements.cores) == pytest.approx(1.0)
    assert sum(w.probability for w in found.weighing.settled) == pytest.approx(1.0)
    assert found.mixture.weight.sum() == pytest.approx(1.0)


def test_a_clear_play_is_named_and_confirmed() -> None:
    found = explained(2, effect(kind="backlash", joint=1, width_deg=0.01))
    assert found.decision.verdict == "explained"
    assert found.decision.confirmed is True
    (finding,) = found.findings
    assert (finding.part.effect, finding.part.joint) == ("backlash", 1)
    assert finding.probability > 0.99
    assert finding.parameters[0].value == pytest.approx(0.01, abs=0.001)
    assert within(found, 3.0)


@pytest.mark.parametrize("per_rev", [8.3, 20.0, 41.7])
def test_a_large_ripple_is_one_ripple_at_its_own_frequency(per_rev: float) -> None:
    """A frequency that is a twentieth of a search step off leaves enough for a second ripple beside it."""
    found = explained(2, effect(kind="gear_cyclic", joint=1, amplitude_deg=0.03, per_rev=per_rev))
    assert found.decision.verdict == "explained"
    assert found.decision.confirmed is True
    (finding,) = found.findings
    sizes = {q.name: q.value for q in finding.parameters}
    assert sizes["per_rev"] == pytest.approx(per_rev, abs=0.02)
    assert sizes["amplitude_deg"] == pytest.approx(0.03, rel=0.02)


def test_a_large_error_is_not_beaten_by_itself_and_a_useless_one() -> None:
    """Settled, it loses what the tangent promised; sets that were not settled keep nothing of that either."""
    wave = effect(kind="scale_cyclic", amplitude_mm=0.0469, period_mm=5.3069, phase_deg=200.0)
    found = explained(105, wave)
    assert found.decision.verdict == "explained"
    assert [f.part.effect for f in found.findings] == ["scale_cyclic"]
    assert found.statements.unnamed < 0.03


def test_one_wrong_ratio_is_the_gain_of_both_joints() -> None:
    gain = {"kind": "transmission_gain", "ppm": 1e4}
    found = explained(3, effect(**gain, joint=1), effect(**gain, joint=2))
    assert {(f.part.effect, f.part.joint) for f in found.findings} == {
        ("transmission_gain", 1),
        ("transmission_gain", 2),
    }
    assert all(f.parameters[0].value == pytest.approx(1e4, rel=0.05) for f in found.findings)
    assert within(found, 3.0)


def test_a_long_distal_link_is_found_through_its_curvature() -> None:
    found = explained(4, effect(kind="link_length", joint=1, link="l", mm=5.0))
    assert found.probability("link_length", 1, "l1") > 0.9
    assert found.position_error[1].rms < 1.0 < found.position_error[0].rms
    assert within(found, 3.0)


@pytest.mark.parametrize(
    ("error", "depends_on", "factor"),
    [
        (effect(kind="encoder_ellipse", joint=2, amplitude_deg=0.01), "joint2", FORM),
        (effect(kind="room_cycle", amplitude_mm=0.02, period_s=60.0), "time", 1.0),
    ],
)
def test_the_form_of_an_error_is_not_sure_where_zero_offsets_may_take_it_up(
    error: tuple[tuple[str, object], ...], depends_on: str, factor: float
) -> None:
    found = explained(5, error)
    assert found.decision.confirmed is False
    best = found.mixture.settled[0]
    assert [f.depends_on for f in best.families] == [depends_on]
    own = next(w.settled for w in found.weighing.settled if w.settled.x is best.x)
    assert np.allclose(best.covariance, factor**2 * own.covariance)


@pytest.mark.parametrize(
    "error",
    [
        effect(kind="belt_stretch", joint=2, deg_at_horizontal=0.06),
        effect(kind="cable_windup", joint=1, deg_at_end=0.08),
        effect(kind="cable_windup", joint=1, deg_at_end=0.08, tightens_deg=30.0),
    ],
)
def test_an_error_without_a_name_that_geometry_takes_up_leaves_the_zeros_right(
    error: tuple[tuple[str, object], ...],
) -> None:
    found = explained(8, error)
    assert found.decision.confirmed is not True or not found.findings
    assert within(found, 2.5)
    assert max(q.sd for q in found.parameters[:2]) < 0.08


@pytest.mark.parametrize("size", [0.003, 0.01])
def test_a_joint_that_sticks_when_it_comes_slowly_is_no_play(size: float) -> None:
    found = explained(6, effect(kind="speed_stiction", joint=1, deg=size))
    assert found.statements.unnamed > 0.5
    assert found.decision.confirmed is False
    assert found.statements.unnamed > 0.5
    assert any(held.depends_on == "approach" for held in found.explanations[0].errors)
    assert within(found, 3.0)


def test_wandering_keeps_its_zero_offsets_wide() -> None:
    found = explained(6, effect(kind="random_walk", mm_per_stop=0.004))
    assert found.decision.confirmed is False
    assert within(found, 4.0)


def test_readings_that_were_learned_on_confirm_nothing() -> None:
    sequence, _ = measured(1)
    found = explain(FiveBar(ROBOT, sequence), sequence)
    assert found.validation is not None
    assert not found.validation.new
    assert found.decision.confirmed is False


def test_fresh_readings_of_one_corner_confirm_nothing() -> None:
    sequence, fresh = measured(1)
    mechanism = FiveBar(ROBOT, sequence)
    corner = mechanism.of(fresh).places(mechanism.start)[:, 0] < -60.0
    found = explain(mechanism, fresh.take(corner))
    assert found.validation is not None
    assert found.validation.coverage[0] < 0.6
    assert found.decision.confirmed is False


def test_a_joint_homed_anew_before_the_fresh_readings_is_seen() -> None:
    sequence, fresh = measured(1)
    shifted = fresh.theta + np.array([0.005, 0.0])
    moved = type(fresh)(**{**{f: getattr(fresh, f) for f in fresh.__dataclass_fields__}, "theta": shifted})
    found = explain(FiveBar(ROBOT, sequence), moved)
    assert found.validation is not None
    assert not found.validation.agrees
    assert found.decision.confirmed is False
    assert found.probability("count_slip", 1) > 0.9


def test_glitches_are_left_out_by_name() -> None:
    sequence, fresh = measured(1)
    distance = sequence.distance.copy()
    distance[[10, 40, 77]] += [0.3, -0.2, 0.4]
    spoiled = type(sequence)(
        **{**{f: getattr(sequence, f) for f in sequence.__dataclass_fields__}, "distance": distance}
    )
    found = explain(FiveBar(ROBOT, spoiled), fresh)
    assert set(found.outliers) == {sequence.ids[k] for k in (10, 40, 77)}
    assert found.decision.verdict == "adequate"


def test_together_keeps_fresh_places_apart() -> None:
    sequence, fresh = measured(1)
    both = together(sequence, fresh)
    assert len(both) == len(sequence) + len(fresh)
    assert not set(both.position[: len(sequence)]) & set(both.position[len(sequence) :])
    assert both.t_s[len(sequence) :].min() > both.t_s[: len(sequence)].max()


def test_commands_bring_the_platform_where_the_set_says() -> None:
    found = explained(2, effect(kind="backlash", joint=1, width_deg=0.01))
    place = ROBOT.workspace_grid(3, 3)
    theta = found.commands(place)
    # zero offsets are taken out of the nominal command to within what geometry adds
    nominal = found.commands(place, np.zeros((9, 2)))
    assert np.allclose(theta, nominal)
    error = found.mixture.position_error(theta, place)
    assert error.rms < 0.6 < error.bound_95


def test_two_large_slips_of_which_the_tangent_promises_too_much() -> None:
    found = explained(
        4,
        effect(kind="count_slip", joint=1, step_deg=-0.1364, from_stop=114),
        effect(kind="count_slip", joint=2, step_deg=0.1613, from_stop=126),
    )
    assert {(f.part.effect, f.part.joint) for f in found.findings} == {("count_slip", 1), ("count_slip", 2)}
    assert sum(w.probability for w in found.weighing.settled) == pytest.approx(1.0)


@pytest.mark.parametrize("seed", [3, 4])
def test_a_slip_of_one_joint_beside_others_is_not_given_to_both(seed: int) -> None:
    """The pair is found first, while a wave and a play are not known yet; it is exchanged for one joint's."""
    found = explained(
        seed,
        effect(kind="count_slip", joint=1, step_deg=0.02, from_stop=40),
        effect(kind="scale_cyclic", amplitude_mm=0.018, period_mm=5.0, phase_deg=41.0),
        effect(kind="backlash", joint=1, width_deg=0.007),
    )
    named = {(f.part.effect, f.part.joint) for f in found.findings}
    assert named == {("count_slip", 1), ("scale_cyclic", None), ("backlash", 1)}
    assert found.decision.confirmed is True


def test_an_effect_without_an_alternative_is_as_probable_as_all_that_hold_it() -> None:
    """A step of one joint is no other name of a step of both: it says nothing of the other joint."""
    drawn = draw(ROBOT, ("count_slip", "scale_cyclic", "backlash"), 13000 * 1_000_003 + 10)
    found = explain(FiveBar(ROBOT, drawn.sequence), drawn.fresh)
    assert any(f.part.key == ("count_slip", 1, None) for f in found.findings)
    for finding in found.findings:
        if not finding.alias_set:
            assert finding.probability == pytest.approx(found.statements.marginals[finding.part.key])
    assert found.decision.verdict == "ambiguous"
