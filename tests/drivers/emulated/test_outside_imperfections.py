"""Imperfections that the diagnosis does not know, each at a point worked out by hand."""

from __future__ import annotations

import math
import time
from typing import get_args

import numpy as np
import pytest

from drivers.emulated import imperfections
from drivers.emulated.imperfections import AnyEffect
from drivers.emulated.imperfections.base import LastStop, turned
from drivers.emulated.machine import Machine
from drivers.emulated.motion import braking, standing, trapezoid
from drivers.emulated.rig_file import dump_rig, parse_rig
from drivers.emulated.spec import MachineSpec, RigSpec
from drivers.emulated.virtual import VirtualRig
from tests.drivers.emulated.quiet import change_mm, quiet, read

HOME = (0.0, 180.0)
Y_HOME_MM = -math.sqrt(825**2 - 455**2)
RHO_HOME_MM = -Y_HOME_MM - 130.0
ASIDE = (9.0, 153.0)
"""A stop with P well to the left."""

OUTSIDE: tuple[AnyEffect, ...] = (
    imperfections.ArmCoupling(joint=1),
    imperfections.AxisTilt(joint=1),
    imperfections.BaseFlex(),
    imperfections.BaseGradient(),
    imperfections.BaseRinging(),
    imperfections.BearingRunout(joint=1),
    imperfections.BeltStretch(joint=2),
    imperfections.CableTorque(joint=1),
    imperfections.CableWindup(joint=2),
    imperfections.EncoderEllipse(joint=1),
    imperfections.GuideSag(),
    imperfections.HealingStep(from_stop=2, for_stops=2),
    imperfections.InterpolationError(),
    imperfections.LinkBend(),
    imperfections.LooseElbow(joint=2),
    imperfections.LooseHead(),
    imperfections.MagnetisedSpot(),
    imperfections.MountingCreep(),
    imperfections.PlatformTilt(),
    imperfections.PlatformYaw(joint=2),
    imperfections.ReadingStep(from_stop=2),
    imperfections.ReadoutLag(),
    imperfections.RestByDistance(joint=1),
    imperfections.ReversalSlip(joint=2),
    imperfections.RoomCycle(),
    imperfections.SinkingBearing(joint=1),
    imperfections.SlippingLink(joint=1, from_stop=2),
    imperfections.SpeedStiction(joint=1),
    imperfections.StiffeningSag(),
    imperfections.WornSector(joint=1),
)
OF_THE_MOMENT = (
    imperfections.BaseGradient,
    imperfections.BaseRinging,
    imperfections.MountingCreep,
    imperfections.RoomCycle,
    imperfections.SinkingBearing,
)
"""Depend on the time of a reading, which no two sequences share to the last digit."""


def check_turn(
    effect: AnyEffect, stops_deg: list[tuple[float, float]], turn_deg: tuple[float, float], **given: object
) -> None:
    """At the last of the stops the arms stand `turn_deg` beside the feedback.  The comparison is a machine
    with zero offsets of that size; a ratio of 1 and fine counts make its stops exact."""
    fine: dict[str, object] = {"counts_per_rev": 36_000_000, "ratio": 1.0, **given}
    last = read(quiet(effect, **fine), *stops_deg)[-1]
    same = read(quiet(**fine, zero_offsets_deg=turn_deg), stops_deg[-1])[0]
    assert last.theta_deg == pytest.approx(stops_deg[-1], abs=1e-5)  # the feedback does not see it
    assert last.true_point_mm == pytest.approx(same.true_point_mm, abs=1e-8)
    assert last.scale_mm == pytest.approx(same.scale_mm, abs=1e-8)


# -- every kind -----------------------------------------------------------------------------------


def test_every_kind_of_usual_size_is_here() -> None:
    """A kind with a default for everything but its joint; the others are tested with their machine."""
    kinds = get_args(get_args(AnyEffect)[0])
    usual = {
        kind.__name__
        for kind in kinds
        if not [name for name, field in kind.model_fields.items() if field.is_required() and name != "joint"]
    }
    assert usual == {type(effect).__name__ for effect in OUTSIDE}


@pytest.mark.parametrize("effect", OUTSIDE, ids=lambda effect: effect.kind)
def test_a_rig_file_names_it_and_it_shows_in_the_readings(effect: AnyEffect) -> None:
    joint = f"joint = {effect.joint}\n" if hasattr(effect, "joint") else ""
    written = parse_rig(f'[[effect]]\nkind = "{effect.kind}"\n{joint}').machine.effects[0]
    assert type(written) is type(effect)
    spec = RigSpec(machine=MachineSpec(effects=(effect,)))
    assert parse_rig(dump_rig(spec)) == spec
    stops = [(9.0 * (k % 3), 180.0 + 9.0 * (k % 2) - 2.0 * k) for k in range(1, 8)]
    assert max(map(abs, change_mm(effect, *stops))) > 2e-4
    assert read(quiet(effect), *stops) == read(quiet(effect), *stops)


@pytest.mark.parametrize(
    "effect", [e for e in OUTSIDE if not isinstance(e, OF_THE_MOMENT)], ids=lambda effect: effect.kind
)
def test_real_time_reads_as_virtual_time_does(effect: AnyEffect) -> None:
    """Each drive is commanded on its own and the head is read on the way, as the station does."""
    stops_pulses = ((10_000, -5_000), (5_000, 2_500), (-2_500, 0))
    machine = Machine(quiet(effect), speed=200.0)
    real_mm = []
    for first, second in stops_pulses:
        machine.command(1, first, rpm=100.0)
        machine.command(2, second, rpm=100.0 * 0.999)
        while machine.axes[0].moving or machine.axes[1].moving:
            machine.head_mm()
            time.sleep(0.001)
        real_mm.append(machine.head_mm())
    clock_machine = VirtualRig(quiet(effect))
    virtual_mm = []
    for first, second in stops_pulses:
        clock_machine.machine.command(1, first, rpm=100.0)
        clock_machine.machine.command(2, second, rpm=100.0 * 0.999)
        clock_machine.clock.advance_to(clock_machine.machine.rests_from_s + 0.2)
        virtual_mm.append(clock_machine.machine.head_mm())
    assert real_mm == pytest.approx(virtual_mm, abs=1e-9)


# -- the joint's angle ------------------------------------------------------------------------------


def test_cable_torque_grows_with_the_cube() -> None:
    effect = imperfections.CableTorque(joint=1, deg_at_end=0.8, reach_deg=40.0)
    check_turn(effect, [(20.0, 180.0)], (-0.1, 0.0))
    check_turn(effect, [(-20.0, 180.0)], (0.1, 0.0))


def test_cable_windup_tightens_one_way() -> None:
    """Wound by 20 of 40 deg, e-fold 20 deg: (e - 1) / (e^2 - 1) = 1 / (e + 1)."""
    effect = imperfections.CableWindup(joint=2, deg_at_end=0.8, reach_deg=40.0, tightens_deg=20.0, winds=-1)
    check_turn(effect, [(0.0, 160.0)], (0.0, 0.8 / (math.e + 1)))
    check_turn(effect, [(0.0, 200.0)], (0.0, 0.8 * (1 / math.e - 1) / (math.e**2 - 1)))


def test_encoder_ellipse_errs_twice_a_turn() -> None:
    """sin(2 * 15 deg) = 1/2; joint 2 at 195 deg has the same phase."""
    check_turn(imperfections.EncoderEllipse(joint=1, amplitude_deg=0.2), [(15.0, 180.0)], (0.1, 0.0))
    check_turn(imperfections.EncoderEllipse(joint=2, amplitude_deg=0.2), [(0.0, 195.0)], (0.0, 0.1))


def test_stiffening_sag_of_both_arms() -> None:
    """At 60 deg and k = 2: 3 * 0.5 / (1 + 2 * 0.5) = 0.75 of the horizontal sag; joint 2 mirrored."""
    effect = imperfections.StiffeningSag(deg_at_horizontal=0.2, stiffening=2.0)
    check_turn(effect, [HOME], (-0.2, 0.2))
    check_turn(effect, [(60.0, 120.0)], (-0.15, 0.15))


def test_belt_stretch_changes_with_the_cube_of_the_travel() -> None:
    """At 60 deg of 60: twice the slackness, half the load."""
    effect = imperfections.BeltStretch(joint=1, deg_at_horizontal=0.2, change=1.0, reach_deg=60.0)
    check_turn(effect, [HOME], (-0.2, 0.0))
    check_turn(effect, [(60.0, 120.0)], (-0.2, 0.0))
    check_turn(effect, [(30.0, 150.0)], (-0.2 * 1.125 * math.sqrt(3) / 2, 0.0))


def test_worn_sector_is_a_hump() -> None:
    effect = imperfections.WornSector(joint=1, deg=0.2, at_deg=10.0, sector_deg=20.0)
    check_turn(effect, [(10.0, 180.0)], (-0.2, 0.0))
    check_turn(effect, [(15.0, 180.0)], (-0.1, 0.0))
    check_turn(effect, [(20.5, 180.0)], (0.0, 0.0))


def test_rest_by_distance_lags_after_a_long_motion() -> None:
    effect = imperfections.RestByDistance(joint=1, deg=0.2, winds_deg=10.0)
    check_turn(effect, [(10.0, 180.0)], (-0.2 * (1 - math.exp(-1)), 0.0))
    check_turn(effect, [(10.0, 180.0), (5.0, 180.0)], (0.2 * (1 - math.exp(-0.5)), 0.0))
    check_turn(effect, [(10.0, 180.0), (10.0, 160.0)], (-0.2 * (1 - math.exp(-1)), 0.0))


def test_speed_stiction_sticks_after_a_slow_motion() -> None:
    """100 rpm over a ratio of 20 are 30 deg/s at the joint; half as far in the same time, 15 deg/s."""
    effect = imperfections.SpeedStiction(joint=1, deg=0.2, frees_deg_per_s=30.0)
    as_usual: dict[str, object] = {"counts_per_rev": 1_800_000, "ratio": 20.0}
    check_turn(effect, [(20.0, 180.0)], (-0.1, 0.0), **as_usual)
    check_turn(effect, [(-20.0, 200.0)], (0.1, 0.0), **as_usual)
    check_turn(effect, [(20.0, 200.0)], (-0.1, 0.0), **as_usual)
    check_turn(effect, [(10.0, 200.0)], (-0.2 / 1.5, 0.0), **as_usual)


def test_reversal_slip_gives_at_each_reversal() -> None:
    effect = imperfections.ReversalSlip(joint=1, deg_up=0.3, deg_down=0.2)
    way = [(10.0, 180.0), (20.0, 180.0), (10.0, 180.0), (20.0, 180.0), (0.0, 180.0)]
    for stops, slipped_deg in ((2, 0.0), (3, -0.2), (4, 0.1), (5, -0.1)):
        check_turn(effect, way[:stops], (slipped_deg, 0.0))


# -- links, centres, platform -------------------------------------------------------------------------


def test_axis_tilt_shortens_along_and_turns_the_shadow() -> None:
    """Leaning by 10 deg along the arm: L cos 10; across it: nothing; at 45 deg: tan b = 1 / cos 10."""
    along = imperfections.AxisTilt(joint=1, tilt_deg=10.0, towards_deg=0.0)
    lost_mm = 375.0 * (1 - math.cos(math.radians(10.0)))
    got = read(quiet(along), HOME)[0].true_point_mm
    assert got == pytest.approx(read(quiet(L_error_mm=(-lost_mm, 0.0)), HOME)[0].true_point_mm, abs=1e-9)
    across = imperfections.AxisTilt(joint=1, tilt_deg=10.0, towards_deg=90.0)
    assert change_mm(across, HOME) == pytest.approx([0.0], abs=1e-9)
    askew = imperfections.AxisTilt(joint=1, tilt_deg=10.0, towards_deg=45.0)
    cosine = math.cos(math.radians(10.0))
    length = 375.0 * math.sqrt((cosine**2 + 1) / 2)
    turn = math.degrees(math.atan2(-1.0, cosine)) + 45.0
    same = quiet(L_error_mm=(length - 375.0, 0.0), zero_offsets_deg=(turn, 0.0))
    assert read(quiet(askew), HOME)[0].true_point_mm == pytest.approx(
        read(same, HOME)[0].true_point_mm, abs=1e-9
    )


def test_link_bend_shortens_flat_links() -> None:
    """At home both links have a slope of cosine 455 / 825."""
    got = read(quiet(imperfections.LinkBend(mm_at_horizontal=0.2)), HOME)[0].true_point_mm
    shorter = -0.2 * (455 / 825) ** 2
    assert got == pytest.approx(read(quiet(l_error_mm=(shorter, shorter)), HOME)[0].true_point_mm, abs=1e-9)


def test_loose_elbow_follows_the_direction() -> None:
    for joint, sides in ((1, (1, -1)), (2, (-1, 1))):
        effect = imperfections.LooseElbow(joint=joint, mm=0.1)  # type: ignore[arg-type]
        stops = [(9.0, 189.0), HOME]
        got = read(quiet(effect), *stops)
        for reading, side in zip(got, sides, strict=True):
            longer = [0.0, 0.0]
            longer[joint - 1] = 0.1 * side
            same = read(quiet(l_error_mm=longer), (reading.theta_deg[0], reading.theta_deg[1]))[0]
            assert reading.true_point_mm == pytest.approx(same.true_point_mm, abs=1e-9)


def test_bearing_runout_carries_the_centre_round() -> None:
    """Twice 45 deg: straight up; at home: to the right.  Only the joint named."""
    effect = imperfections.BearingRunout(joint=1, amplitude_mm=0.1)
    for stop, shift in ((HOME, (0.1, 0.0, 0.0, 0.0)), ((45.0, 135.0), (0.0, 0.1, 0.0, 0.0))):
        same = read(quiet(e_error_mm=shift), stop)[0]
        assert read(quiet(effect), stop)[0].true_point_mm == pytest.approx(same.true_point_mm, abs=1e-9)


def test_base_flex_follows_the_place() -> None:
    """P at home is at x = 0: nothing.  Elsewhere both centres go aside in proportion to x."""
    effect = imperfections.BaseFlex(sideways_mm=0.1, reach_mm=200.0)
    assert change_mm(effect, HOME) == pytest.approx([0.0], abs=1e-12)
    rigid = read(quiet(), ASIDE)[0].true_point_mm
    aside = 0.1 * rigid[0] / 200.0
    assert rigid[0] < -50
    got = read(quiet(effect), ASIDE)[0].true_point_mm
    assert got == pytest.approx((rigid[0] + aside, rigid[1]), abs=1e-9)


def test_base_flex_rolls_the_centres_about_the_base() -> None:
    """Turning (80, 0) and (-80, 0) by a: (cos a - 1, sin a) times 80, opposite on the left."""
    rigid = read(quiet(), ASIDE)[0].true_point_mm
    effect = imperfections.BaseFlex(sideways_mm=0.0, roll_deg=0.2, reach_mm=abs(rigid[0]))
    a = math.radians(math.copysign(0.2, rigid[0]))
    x, y = 80 * (math.cos(a) - 1), 80 * math.sin(a)
    same = read(quiet(e_error_mm=(x, y, -x, -y)), ASIDE)[0]
    got = read(quiet(effect), ASIDE)[0].true_point_mm
    assert got == pytest.approx(same.true_point_mm, abs=1e-9)


def test_base_gradient_warms_one_side() -> None:
    """After one time constant 1 - 1/e of it; joint 2 is on the left, so outwards is to the left."""
    stop = (9.0, 180.0)
    at_s = read(quiet(), stop)[0].t_s
    warmth = 1 - math.exp(-1)
    for joint, shift in ((1, (0.3, 0.1, 0.0, 0.0)), (2, (0.0, 0.0, -0.3, 0.1))):
        effect = imperfections.BaseGradient(joint=joint, out_mm=0.3, up_mm=0.1, tau_s=at_s)  # type: ignore[arg-type]
        same = read(quiet(e_error_mm=[part * warmth for part in shift]), stop)[0]
        got = read(quiet(effect), stop)[0]
        assert got.true_point_mm == pytest.approx(same.true_point_mm, abs=1e-9)
        assert got.temperature_rise_k == 0.0


def test_a_bearing_sinks_with_time() -> None:
    stop = (9.0, 180.0)
    at_s = read(quiet(), stop)[0].t_s
    effect = imperfections.SinkingBearing(joint=2, mm_per_min=0.6)
    same = read(quiet(e_error_mm=(0.0, 0.0, 0.0, -0.01 * at_s)), stop)[0]
    assert read(quiet(effect), stop)[0].true_point_mm == pytest.approx(same.true_point_mm, abs=1e-9)


def test_a_link_slips_once() -> None:
    effect = imperfections.SlippingLink(joint=1, mm=0.3, from_stop=2)
    got = read(quiet(effect), HOME, ASIDE, HOME)
    longer = read(quiet(l_error_mm=(0.3, 0.0)), HOME, ASIDE, HOME)
    assert got[0].true_point_mm == pytest.approx((0.0, Y_HOME_MM), abs=1e-9)
    for after, same in zip(got[1:], longer[1:], strict=True):
        assert after.true_point_mm == pytest.approx(same.true_point_mm, abs=1e-9)


def test_an_arm_twists_the_bracket_of_the_other_joint() -> None:
    """At 180 degrees the other arm lies flat and pulls the other way; at 120 it is half."""
    effect = imperfections.ArmCoupling(joint=1, deg_at_horizontal=0.2)
    check_turn(effect, [(0.0, 180.0)], (-0.2, 0.0))
    check_turn(effect, [(20.0, 120.0)], (-0.1, 0.0))


def test_a_loose_head_scatters_and_does_not_wander() -> None:
    changes = change_mm(imperfections.LooseHead(sd_mm=0.01), *[(float(k % 7), 180.0) for k in range(401)])
    assert np.std(changes) == pytest.approx(0.01, rel=0.15)
    assert abs(np.corrcoef(changes[1:], changes[:-1])[0, 1]) < 0.15


def test_platform_tilt_moves_the_mechanism_and_not_the_platform() -> None:
    """(0, -51) turned by a is (51 sin a, -51 cos a)."""
    rigid = read(quiet(), ASIDE)[0].true_point_mm
    effect = imperfections.PlatformTilt(deg_at_reach=2.0, reach_mm=abs(rigid[0]))
    a = math.radians(math.copysign(2.0, rigid[0]))
    got = read(quiet(effect), ASIDE)[0]
    assert got.true_point_mm == pytest.approx(rigid, abs=1e-12)
    head = (rigid[0] + 51 * math.sin(a), rigid[1] + 51 * (1 - math.cos(a)))
    assert got.scale_mm == pytest.approx(math.hypot(head[0], head[1] + 130.0), abs=1e-9)


@pytest.mark.parametrize(("joint", "side"), [(1, 1), (2, -1)])
def test_platform_yaw_follows_its_link(joint: int, side: int) -> None:
    """Nothing at home.  With both arms at 90 deg the elbows are over the joints, at a cosine of 80 / 825."""
    effect = imperfections.PlatformYaw(joint=joint, share=0.1)  # type: ignore[arg-type]
    assert change_mm(effect, HOME) == pytest.approx([0.0], abs=1e-6)
    y = 375.0 - math.sqrt(825**2 - 80**2)
    link_turned = math.acos(80 / 825) - math.acos(455 / 825)
    a = 0.1 * link_turned * side
    expected = math.hypot(51 * math.sin(a), y + 51 * (1 - math.cos(a)) + 130.0)
    got = read(quiet(effect), (90.0, 90.0))[0].scale_mm
    assert got == pytest.approx(expected, abs=1e-4)  # the link's direction at home is known to 0.001 deg


# -- the reading --------------------------------------------------------------------------------------


def test_guide_sag_is_travel_squared_times_place() -> None:
    """Drawn out by half of `draw_mm` and at half of `reach_mm` to the left: -1/8."""
    left = read(quiet(), ASIDE)[0]
    effect = imperfections.GuideSag(
        mm_at_corner=0.4,
        short_mm=left.scale_mm - 50.0,
        draw_mm=100.0,
        reach_mm=-2 * left.true_point_mm[0],
    )
    assert change_mm(effect, ASIDE) == pytest.approx([-0.4 / 8])
    assert change_mm(effect, HOME) == pytest.approx([0.0], abs=1e-12)


def test_magnetised_spot_leads_and_holds_back() -> None:
    def spot(aside_mm: float) -> AnyEffect:
        return imperfections.MagnetisedSpot(rho_mm=RHO_HOME_MM - aside_mm, half_width_mm=10.0, peak_mm=0.02)

    for aside_mm, expected in ((0.0, 0.0), (-10.0, 0.02), (10.0, -0.02), (20.0, -0.04 * math.exp(-1.5))):
        assert change_mm(spot(aside_mm), HOME) == pytest.approx([expected], abs=1e-9)


def test_interpolation_error_has_a_harmonic() -> None:
    """A quarter period: the first sine is 1; twice it is half a turn, so the second is -sin of its phase."""
    effect = imperfections.InterpolationError(
        amplitude_mm=0.01, period_mm=4 * RHO_HOME_MM, second_share=0.5, second_phase_deg=30.0
    )
    assert change_mm(effect, HOME) == pytest.approx([0.01 * (1 - 0.25)])


def test_mounting_creep_and_room_cycle_follow_time() -> None:
    at_s = read(quiet(), (9.0, 180.0))[0].t_s
    creep = imperfections.MountingCreep(mm_per_decade=0.02, from_s=at_s / 99)
    assert change_mm(creep, (9.0, 180.0)) == pytest.approx([0.04])
    cycle = imperfections.RoomCycle(amplitude_mm=0.02, period_s=4 * at_s)
    assert change_mm(cycle, (9.0, 180.0)) == pytest.approx([0.02])


def test_steps_come_and_one_of_them_goes() -> None:
    stops = [(float(k), 180.0) for k in range(1, 6)]
    stays = change_mm(imperfections.ReadingStep(step_mm=0.02, from_stop=3), *stops)
    assert stays == pytest.approx([0.0, 0.0, 0.02, 0.02, 0.02])
    heals = change_mm(imperfections.HealingStep(step_mm=0.02, from_stop=2, for_stops=2), *stops)
    assert heals == pytest.approx([0.0, 0.02, 0.02, 0.0, 0.0])


def test_readout_lag_holds_a_part_of_the_last_value() -> None:
    stops = [HOME, (9.0, 171.0), (9.0, 162.0)]
    still = [reading.scale_mm for reading in read(quiet(), *stops)]
    lag = change_mm(imperfections.ReadoutLag(share=0.1), *stops)
    assert lag == pytest.approx([0.0, 0.1 * (still[0] - still[1]), 0.1 * (still[1] - still[2])])


def test_base_ringing_dies_out() -> None:
    """Read 0.2 s after rest: one full swing of 5 Hz, and e^-2 of it left; 30 deg/s came in."""
    effect = imperfections.BaseRinging(mm_at_100_deg_per_s=1.0, frequency_hz=5.0, tau_s=0.1)
    assert change_mm(effect, (9.0, 180.0), HOME) == pytest.approx(
        [0.3 * math.exp(-2), -0.3 * math.exp(-2)], rel=1e-6
    )


# -- what the effects see -----------------------------------------------------------------------------


def test_top_speed_of_a_motion() -> None:
    assert trapezoid(0.0, -100.0, top_speed=10.0, acceleration=10.0).top_speed == pytest.approx(10.0)
    assert trapezoid(0.0, 10.0, top_speed=100.0, acceleration=10.0).top_speed == pytest.approx(10.0)
    assert braking(0.0, -4.0, deceleration=2.0).top_speed == 4.0
    assert standing(1.0).top_speed == 0.0


def test_last_stop_remembers_the_first_value_of_a_stop() -> None:
    last = LastStop()
    assert [last.before(*seen) for seen in ((0, 1.0), (0, 2.0), (1, 3.0), (1, 4.0), (3, 5.0))] == [
        None,
        None,
        1.0,
        1.0,
        3.0,
    ]


def test_turned() -> None:
    assert turned((2.0, 0.0), 90.0) == pytest.approx((-2.0, 2.0))
