"""The emulated machine against values worked out by hand or printed in the paper."""

from __future__ import annotations

import math
import statistics
import time
from itertools import pairwise

import pytest

from drivers.emulated import imperfections as effects
from drivers.emulated.imperfections import AnyEffect
from drivers.emulated.machine import Machine, Unreachable, lower_meeting_point
from drivers.emulated.motion import braking, standing, trapezoid
from drivers.emulated.rig_file import RIGS, load_rig
from drivers.emulated.spec import MachineSpec
from drivers.emulated.virtual import VirtualClock, VirtualRig
from tests.drivers.emulated.quiet import change_mm, quiet, read

HOME = (0.0, 180.0)


# -- geometry ------------------------------------------------------------------------------------


def test_home_of_the_nominal_machine() -> None:
    """theta = 0, 180 deg: elbows at (+-455, 0), so y = -sqrt(825^2 - 455^2)."""
    reading = read(quiet(), HOME)[0]
    x, y = reading.true_point_mm
    assert x == pytest.approx(0.0, abs=1e-9)
    assert y == pytest.approx(-math.sqrt(825**2 - 455**2), abs=1e-9)
    assert y == pytest.approx(-688.186, abs=5e-4)
    assert reading.scale_mm == pytest.approx(688.186 - 130.0, abs=5e-4)


def test_zero_offset_turns_the_arm_and_not_the_drive() -> None:
    offset = read(quiet(zero_offsets_deg=(1.8, -0.9)), HOME)[0]
    turned = read(quiet(), (1.8, 179.1))[0]
    assert offset.theta_deg == pytest.approx(HOME)
    assert offset.true_point_mm == pytest.approx(turned.true_point_mm, abs=1e-4)


def test_both_arms_up_raise_the_point() -> None:
    """theta = 30, 150 deg: elbows at (+-404.76, 187.5)."""
    x_elbow = 80 + 375 * math.cos(math.radians(30))
    reading = read(quiet(counts_per_rev=360_000, ratio=1), (30.0, 150.0))[0]
    assert reading.true_point_mm[1] == pytest.approx(187.5 - math.sqrt(825**2 - x_elbow**2), abs=1e-9)


@pytest.mark.parametrize(
    ("given", "y_change"),
    [
        ({"e_error_mm": (0.0, 0.1, 0.0, 0.1)}, 0.1),
        ({"e_error_mm": (0.1, 0.0, 0.1, 0.0)}, 0.0),
        ({"L_error_mm": (0.1, 0.1)}, 0.1 * 455 / 688.186),
        ({"l_error_mm": (0.1, 0.1)}, -0.1 * 825 / 688.186),
    ],
)
def test_geometric_errors_move_home_as_the_triangle_says(given: dict[str, object], y_change: float) -> None:
    y = read(quiet(**given), HOME)[0].true_point_mm[1]
    assert y + 688.186 == pytest.approx(y_change, abs=6e-4)


def test_maemm_is_what_the_distance_is_short_of() -> None:
    """rho = |r - c - d - dr_M| = |(-1, -558.686)|."""
    reading = read(quiet(drm_mm=(1.0, 0.5)), HOME)[0]
    assert reading.scale_mm == pytest.approx(math.hypot(1.0, 558.686), abs=5e-4)


def joints_deg(x_mm: float, y_mm: float) -> tuple[float, float]:
    """Nominal joint angles of a place, by the cosine rule in the triangle A_i, B_i, P."""
    angles = []
    for e_x, outwards in ((80.0, 1), (-80.0, -1)):
        reach = math.hypot(x_mm - e_x, y_mm)
        opening = math.acos((375**2 + reach**2 - 825**2) / (2 * 375 * reach))
        angles.append(math.degrees(math.atan2(y_mm, x_mm - e_x) + outwards * opening) % 360)
    return (angles[0] + 180) % 360 - 180, angles[1]


@pytest.mark.parametrize(
    ("group", "home_mm", "largest_mm"),
    [
        (1, 10.933, 12.906),
        (2, 5.482, 6.418),
        (3, 3.796, 4.672),
        (4, 10.897, 12.868),
        (5, 5.518, 6.455),
        (6, 3.798, 4.663),
    ],
)
def test_position_errors_before_calibration_are_the_papers(
    group: int, home_mm: float, largest_mm: float
) -> None:
    """Tables 3 and 4, column "before": the error of P_0 and the largest at the six boundary positions."""
    paper = load_rig(RIGS / f"paper_group{group}.toml").machine
    rig = VirtualRig(paper.model_copy(update={"scatter": False, "counts_per_rev": 10**9}))

    def error_mm(x_mm: float, y_mm: float) -> float:
        return math.dist(rig.stop_at(joints_deg(x_mm, y_mm)).true_point_mm, (x_mm, y_mm))

    assert error_mm(0.0, -math.sqrt(825**2 - 455**2)) == pytest.approx(home_mm, abs=0.002)
    boundary = [(x, y) for x in (-240.0, 0.0, 240.0) for y in (-632.0, -782.0)]
    assert max(error_mm(*place) for place in boundary) == pytest.approx(largest_mm, abs=0.001)


def test_head_constant() -> None:
    assert read(quiet(head_zero_mm=437.25), HOME)[0].scale_mm == pytest.approx(558.186 - 437.25, abs=5e-4)


def test_links_that_cannot_meet() -> None:
    with pytest.raises(Unreachable):
        lower_meeting_point((0.0, 0.0), 1.0, (3.0, 0.0), 1.0)
    assert lower_meeting_point((0.0, 0.0), 5.0, (6.0, 0.0), 5.0) == pytest.approx((3.0, -4.0))


# -- randomness ----------------------------------------------------------------------------------


def test_scale_noise_has_the_papers_size() -> None:
    rig = VirtualRig(MachineSpec(scatter=False))
    readings = [rig.machine.head_mm() for _ in range(4000)]
    assert statistics.stdev(readings) == pytest.approx(1.117e-3, rel=0.05)


def test_servo_scatter_has_the_papers_size_and_feedback_sees_it() -> None:
    spec = MachineSpec(scale_noise_mm=0.0)
    readings = read(spec, *[(10.0 * (k % 2), 180.0) for k in range(2000)])
    beside = [reading.theta_deg[0] - 10.0 * (k % 2) for k, reading in enumerate(readings)]
    assert statistics.stdev(beside) == pytest.approx(0.0024, rel=0.05)
    pulses = [reading.theta_deg[0] / 0.0018 for reading in readings]
    assert all(abs(value - round(value)) < 1e-6 for value in pulses)


@pytest.mark.parametrize("whole", [True, False])
def test_servos_rest_on_a_pulse_or_between_two(whole: bool) -> None:
    rig = VirtualRig(MachineSpec(whole_pulses=whole))
    rig.measure([(10.0, 175.0), (0.0, 180.0)])
    assert all((axis.shaft_pulses == round(axis.shaft_pulses)) is whole for axis in rig.machine.axes)


def test_same_seed_same_walk() -> None:
    stops = [(5.0, 175.0), (0.0, 180.0)]
    first, again = VirtualRig(MachineSpec()).measure(stops), VirtualRig(MachineSpec()).measure(stops)
    other = VirtualRig(MachineSpec(), seed=2).measure(stops)
    assert first == again != other


def moving(machine: Machine) -> bool:
    return machine.axes[0].moving


# -- motion --------------------------------------------------------------------------------------


def test_trapezoid_and_triangle() -> None:
    long = trapezoid(0.0, 100.0, top_speed=10.0, acceleration=10.0)
    assert long.duration_s == pytest.approx(11.0)
    assert long.at(0.5) == pytest.approx((1.25, 5.0))
    assert long.at(5.5) == pytest.approx((50.0, 10.0))
    assert long.at(99.0) == (100.0, 0.0)
    short = trapezoid(0.0, -10.0, top_speed=100.0, acceleration=10.0)
    assert short.duration_s == pytest.approx(2.0)
    assert short.at(1.0) == pytest.approx((-5.0, -10.0))
    assert trapezoid(3.0, 3.0, 1.0, 1.0).at(0.5) == (3.0, 0.0)
    assert standing(7.0).at(1.0) == (7.0, 0.0)


def test_braking_ends_where_the_deceleration_says() -> None:
    motion = braking(10.0, -4.0, deceleration=2.0)
    assert motion.duration_s == pytest.approx(2.0)
    assert motion.at(5.0) == pytest.approx((6.0, 0.0))


def test_a_move_takes_its_time_and_a_factor_shortens_it() -> None:
    for speed in (1.0, 50.0):
        clock = VirtualClock()
        machine = Machine(quiet(), clock, speed=speed)
        machine.command(1, 20_000, rpm=60.0)  # two motor turns at one a second, ramps 6 ms
        assert machine.rests_from_s == pytest.approx(2.006 / speed)
        clock.advance_to(machine.rests_from_s / 2)
        assert moving(machine)
        assert machine.axes[0].feedback_pulses() == pytest.approx(10_000, abs=1)
        clock.advance_to(machine.rests_from_s)
        assert not moving(machine)
        assert machine.axes[0].feedback_pulses() == 20_000


def test_quick_stop_stops_on_the_way() -> None:
    clock = VirtualClock()
    machine = Machine(quiet(), clock)
    machine.command(1, 20_000, rpm=60.0)
    clock.advance_to(1.0)
    machine.quick_stop(1)
    clock.advance_to(1.01)
    assert not moving(machine)
    assert 9_900 < machine.axes[0].feedback_pulses() < 10_100


def test_declared_zero_shifts_the_true_offset() -> None:
    rig = VirtualRig(quiet(zero_offsets_deg=(2.0, 0.0)))
    rig.stop_at((-2.0, 180.0))
    axis = rig.machine.axes[0]
    axis.declare_zero()
    assert axis.feedback_pulses() == 0
    assert axis.zero_offset_deg == pytest.approx(0.0, abs=0.001)
    assert rig.stop_at((0.0, 180.0)).true_point_mm[0] == pytest.approx(0.0, abs=0.01)


def test_left_machine_is_found_where_it_was() -> None:
    rig = VirtualRig(MachineSpec())
    rig.stop_at((12.0, 170.0))
    rig.machine.axes[0].declare_zero()
    again = VirtualRig(MachineSpec())
    again.machine.restore(rig.machine.state())
    assert again.machine.point_mm() == rig.machine.point_mm()
    assert again.machine.axes[0].feedback_pulses() == 0


def test_a_sequence_in_virtual_time_does_not_wait(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delattr(time, "sleep")
    sequence = read(MachineSpec(), *[(10.0 * (k % 3), 180.0 - 7.0 * (k % 5)) for k in range(120)])
    assert sequence[-1].t_s > 60.0


# -- effects, each where it acts -----------------------------------------------------------------


def test_backlash_lags_by_half_its_width_either_way() -> None:
    spec = quiet(effects.Backlash(joint=1, width_deg=1.8))
    up, down, still_down = read(spec, (9.0, 180.0), (4.5, 180.0), HOME)
    expected = [read(quiet(), (theta, 180.0))[0] for theta in (8.1, 5.4, 0.9)]
    for reading, same in zip((up, down, still_down), expected, strict=True):
        assert reading.true_point_mm == pytest.approx(same.true_point_mm, abs=1e-6)
    assert (up.approach, down.approach) == ((1, 0), (-1, 0))


def test_backlash_holds_the_arm_inside_its_width() -> None:
    spec = quiet(effects.Backlash(joint=1, width_deg=0.5))
    out, back_a_little = read(spec, (10.0, 180.0), (9.7, 180.0))
    assert back_a_little.true_point_mm == out.true_point_mm


def test_gear_cyclic_repeats_with_its_period() -> None:
    effect = effects.GearCyclic(joint=1, amplitude_deg=0.01, per_rev=20)
    at_zero, quarter, full = change_mm(effect, HOME, (4.5, 180.0), (18.0, 180.0))
    assert at_zero == pytest.approx(0.0, abs=1e-9)
    assert full == pytest.approx(0.0, abs=1e-6)
    slope = read(quiet(), (4.5, 180.0), (4.5 + 0.09, 180.0))
    assert quarter == pytest.approx((slope[1].scale_mm - slope[0].scale_mm) / 9, rel=0.01)


@pytest.mark.parametrize(
    ("effect", "stop_deg", "same_as_deg"),
    [
        (effects.EncoderEccentricity(joint=1, amplitude_deg=0.9, phase_deg=90), HOME, (0.9, 180.0)),
        (effects.TransmissionGain(joint=2, ppm=100_000), (0.0, 162.0), (0.0, 160.2)),
        (effects.Compliance(joint=1, deg_at_horizontal=0.9), HOME, (-0.9, 180.0)),
        (effects.Compliance(joint=2, deg_at_horizontal=0.9), HOME, (0.0, 180.9)),
        (effects.CableDrag(joint=1, deg_at_end=0.9, reach_deg=18.0), (18.0, 180.0), (17.1, 180.0)),
        (effects.CountSlip(joint=1, step_deg=0.9, from_stop=1), HOME, (0.9, 180.0)),
    ],
)
def test_joint_effects_turn_the_arm(
    effect: AnyEffect, stop_deg: tuple[float, float], same_as_deg: tuple[float, float]
) -> None:
    reading, same = read(quiet(effect), stop_deg)[0], read(quiet(), same_as_deg)[0]
    assert reading.theta_deg == pytest.approx(stop_deg)  # the feedback does not see it
    assert reading.true_point_mm == pytest.approx(same.true_point_mm, abs=1e-6)


def test_count_slip_comes_and_stays() -> None:
    effect = effects.CountSlip(joint=1, step_deg=0.02, from_stop=2)
    changes = change_mm(effect, (1.0, 180.0), (2.0, 180.0), (1.0, 180.0), (2.0, 180.0))
    assert [abs(change) > 0.01 for change in changes] == [False, True, True, True]


def test_link_length_and_clearance_lengthen_a_pulled_link() -> None:
    longer = read(quiet(effects.LinkLength(joint=1, link="l", mm=0.1)), HOME)[0]
    assert longer.true_point_mm == pytest.approx(
        read(quiet(l_error_mm=(0.1, 0.0)), HOME)[0].true_point_mm, abs=1e-9
    )
    clearance = read(quiet(effects.JointClearance(joint=1, mm=0.1)), HOME)[0]
    assert clearance.true_point_mm == pytest.approx(longer.true_point_mm, abs=1e-9)
    proximal = read(quiet(effects.LinkLength(joint=2, link="L", mm=0.1)), HOME)[0]
    assert proximal.true_point_mm == pytest.approx(
        read(quiet(L_error_mm=(0.0, 0.1)), HOME)[0].true_point_mm, abs=1e-9
    )


def test_scale_effects_add_to_the_reading() -> None:
    rho = read(quiet(), HOME)[0].scale_mm
    assert change_mm(effects.ScaleGain(ppm=100.0), HOME) == [pytest.approx(rho * 1e-4)]
    assert change_mm(effects.ScaleBow(mm_at_end=0.04), HOME) == [
        pytest.approx(0.04 * ((rho - 600) / 100) ** 2, abs=1e-9)
    ]
    assert change_mm(effects.ScaleCyclic(amplitude_mm=0.01, period_mm=2 * rho, phase_deg=90.0), HOME) == [
        pytest.approx(-0.01)
    ]
    dent = effects.StictionPatch(x_mm=0.0, y_mm=-688.186, radius_mm=20.0, depth_mm=0.05)
    assert change_mm(dent, HOME, (20.0, 160.0)) == [pytest.approx(-0.05), pytest.approx(0.0, abs=1e-4)]


def test_scale_hysteresis_follows_the_slider_and_not_the_joints() -> None:
    """Both arms up pull the slider in, both down push it out."""
    effect = effects.ScaleHysteresis(width_mm=0.02)
    assert change_mm(effect, (10.0, 170.0), HOME) == pytest.approx([0.01, -0.01])


def test_drift_and_growth_follow_time() -> None:
    spec = quiet(effects.Drift(mm_per_hour=3.6))
    first, later = read(spec, HOME, (20.0, 180.0))
    still = read(quiet(), HOME, (20.0, 180.0))
    assert first.scale_mm - still[0].scale_mm == pytest.approx(first.t_s * 1e-3)
    assert later.scale_mm - still[1].scale_mm == pytest.approx(later.t_s * 1e-3)
    warm = effects.ThermalGrowth(rise_k=10.0, tau_s=1e-6, links_um_per_m_per_k=12.0)
    grown = read(quiet(warm), HOME)[0]
    assert grown.temperature_rise_k == pytest.approx(10.0)
    y = read(quiet(L_mm=(375.045, 375.045), l_mm=(825.099, 825.099)), HOME)[0].true_point_mm[1]
    assert grown.true_point_mm[1] == pytest.approx(y, abs=1e-9)
    scale = effects.ThermalGrowth(rise_k=10.0, tau_s=1e-6, scale_um_per_m_per_k=10.0)
    assert change_mm(scale, HOME) == [pytest.approx(-558.186e-4, rel=1e-6)]


def test_outliers_hit_some_stops_by_their_size() -> None:
    stops = [(float(k % 7), 180.0) for k in range(400)]
    changes = change_mm(effects.Outliers(rate=0.1, size_mm=0.5), *stops)
    hits = [abs(change) > 0.1 for change in changes]
    assert 20 < sum(hits) < 60
    assert {round(abs(change), 6) for change in changes} == {0.0, 0.5}


def test_random_walk_wanders_with_the_root_of_the_stops() -> None:
    stops = [(float(k % 7), 180.0) for k in range(401)]
    changes = change_mm(effects.RandomWalk(mm_per_stop=0.01), *stops)
    steps = [after - before for before, after in pairwise(changes)]
    assert statistics.stdev(steps) == pytest.approx(0.01, rel=0.15)


def test_effects_of_one_machine_do_not_remember_another() -> None:
    spec = quiet(effects.Backlash(joint=1, width_deg=0.5), effects.RandomWalk(mm_per_stop=0.01))
    stops = [(10.0, 180.0), (0.0, 170.0)]
    assert read(spec, *stops) == read(spec, *stops)
