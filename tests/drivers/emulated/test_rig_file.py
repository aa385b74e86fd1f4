"""Rig files: read, written, and refused in one sentence."""

from __future__ import annotations

from pathlib import Path

import pytest

from drivers.emulated import imperfections as effects
from drivers.emulated.rig_file import DEFAULT_RIG, RIGS, RigFileError, dump_rig, load_rig, parse_rig
from drivers.emulated.spec import EmulationSpec, Fault, MachineSpec, RigSpec


def test_default_rig_is_group_1_of_the_paper() -> None:
    machine = load_rig(DEFAULT_RIG).machine
    assert machine.zero_offsets_deg == (2.0, -1.0)
    assert machine.e_error_mm == (0.03, -0.02, -0.02, 0.01)
    assert (machine.L_error_mm, machine.l_error_mm) == ((0.01, 0.02), (-0.03, -0.02))
    assert machine.drm_mm == (1.0, 0.5)


@pytest.mark.parametrize("path", sorted(RIGS.glob("*.toml")), ids=lambda path: path.stem)
def test_every_shipped_rig_loads(path: Path) -> None:
    load_rig(path)


def test_written_rig_reads_back() -> None:
    spec = RigSpec(
        machine=MachineSpec(
            seed=7,
            zero_offsets_deg=(0.5, -0.25),
            sign=(1, -1),
            effects=(
                effects.Backlash(joint=2, width_deg=0.01),
                effects.LinkLength(joint=1, link="L", mm=0.2),
                effects.Outliers(rate=0.05, size_mm=0.1),
            ),
        ),
        emulated=EmulationSpec(speed=10.0, state_file="place.json"),
        faults=(
            Fault(kind="drive_alarm", joint=1, after=3, code=0x180),
            Fault(kind="scale_late", delay_s=2.0),
        ),
    )
    assert parse_rig(dump_rig(spec)) == spec


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("[machine", "rig file is not TOML"),
        ("[robot]", r"unknown table \[robot\]"),
        ("machine = 3", "machine and emulated are tables"),
        ("[[effect]]\nwidth_deg = 1", r"\[\[effect\]\] 1: unable to extract tag"),
        ('effect = "backlash"', r"\[\[effect\]\]: input should be a valid tuple"),
        ("[machine]\neffects = []", r"written as \[\[effect\]\] tables"),
        ("[machine]\nzero_offset_deg = [1, 2]", r"\[machine\] zero_offset_deg: extra inputs"),
        ("[machine]\nl_mm = [825, -1]", r"\[machine\] l_mm\.1: input should be greater than 0"),
        ("[machine]\nscale_noise_mm = nan", r"\[machine\] scale_noise_mm: input should be a finite number"),
        ("[emulated]\nspeed = 0", r"\[emulated\] speed: input should be greater than 0"),
        ('[[effect]]\nkind = "gremlins"', r"\[\[effect\]\] 1: .*gremlins"),
        ('[[effect]]\nkind = "backlash"\njoint = 3\nwidth_deg = 1', r"\[\[effect\]\] 1 backlash\.joint"),
        ('[[fault]]\nkind = "scale_late"\n[[fault]]\nkind = "fire"', r"\[\[fault\]\] 2 kind"),
    ],
)
def test_refused_in_one_sentence(text: str, complaint: str) -> None:
    with pytest.raises(RigFileError, match=complaint) as caught:
        parse_rig(text)
    assert "\n" not in str(caught.value) and str(caught.value).endswith(".")


def test_file_that_is_no_text(tmp_path: Path) -> None:
    path = tmp_path / "rig.toml"
    path.write_bytes(b"\xff\xfe")
    with pytest.raises(RigFileError, match="is not text in UTF-8"):
        load_rig(path)


def test_missing_file(tmp_path: Path) -> None:
    with pytest.raises(RigFileError, match="cannot be read: No such file"):
        load_rig(tmp_path / "none.toml")
