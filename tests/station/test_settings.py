"""A station file is taken as a whole or refused in one sentence."""

from __future__ import annotations

from pathlib import Path

import pytest

from drivers.scales.heidenhain_nd import HeidenhainSettings
from drivers.scaling import JointScaling
from station.errors import InputRefused
from station.home import station_home
from station.motion.devices import build_devices
from station.settings import FolderSettings, Settings, backup_folder, database_path, load_settings

REAL = """
name = "Line 3"
[scale]
protocol = "heidenhain-nd"
url = "serial:///dev/ttyUSB0?baud=9600&format=7E2"
[servo]
profile = "leadshine-el7"
url = "modbus+rtu:///dev/ttyUSB1?baud=38400&format=8N2"
[[servo.joint]]
unit = 1
sign = 1
zero_at_deg = 0
[[servo.joint]]
unit = 2
sign = -1
zero_at_deg = 180
[limits]
speed_deg_s = 20
samples = 4
[service]
port = 8123
"""


def load(tmp_path: Path, text: str) -> Settings:
    path = tmp_path / "station.toml"
    path.write_text(text, encoding="utf-8")
    return load_settings(path)


def test_a_station_file_becomes_settings_and_drivers(tmp_path: Path) -> None:
    settings = load(tmp_path, REAL)
    assert settings.joints[1].scaling == JointScaling(10_000, 20.0, 180.0, -1)
    devices = build_devices(settings)
    assert devices.scale.name == "linear scale"
    assert [axis.name for axis in devices.axes] == ["servo axis 1", "servo axis 2"]
    assert devices.addresses[2].endswith("unit 2")
    assert not devices.emulated


def test_the_example_states_the_defaults() -> None:
    example = load_settings(Path(__file__).parents[2] / "docs" / "examples" / "station.toml")
    assert example.limits == Settings().limits
    assert example.service == Settings().service
    assert example.emulated == Settings().emulated
    assert example.joints == Settings().joints
    assert build_devices(example).addresses[0].startswith("serial:///dev/ttyUSB0")


def test_without_a_file_the_defaults_name_no_devices() -> None:
    assert load_settings(None) == Settings()
    with pytest.raises(InputRefused, match="names no devices"):
        build_devices(Settings())


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (("speed_deg_s = 20", "speed_deg_s = 900"), r"\[limits\] speed_deg_s: .*180.*given: 900"),
        (("samples = 4", "sampels = 4"), r"\[limits\] sampels is not an option"),
        (("port = 8123", "port = 'x'"), r"\[service\] port: .*integer.*given: 'x'"),
        (("sign = -1", "sign = 0"), r"sign must be 1 or -1"),
        (("unit = 2", "unit = 1"), r"\[servo\].*different units"),
        (('url = "modbus+rtu:///dev/ttyUSB1?baud=38400&format=8N2"', ""), r"\[servo\] url is missing"),
        (('format=7E2"', 'format=7E2"\naddress = 3'), r"\[scale\] address is not an option"),
        (('format=8N2"', 'format=8N2"\ntimeout_s = 20'), r"\[servo\] timeout_s: .*10.*given: 20"),
        (("zero_at_deg = 180", "zero_at_deg = nan"), r"\[servo.joint.1\] zero_at_deg"),
        (('name = "Line 3"', "name = "), "is not valid TOML"),
        (("[scale]", "[scan]\nserial = '('\n[scale]"), r"\[scan\] serial: is no regular expression"),
        (("[scale]", "[scan]\nbadge = '(?P<n>.)'\n[scale]"), r"\[scan\] badge: .*no other \(\?"),
        (("[scale]", "[scan]\nbadge = '.*'\n[scale]"), r"\[scan\].*must not fit the pattern of a badge"),
    ],
)
def test_what_is_wrong_is_named_with_section_option_bounds_and_value(
    tmp_path: Path, change: tuple[str, str], sentence: str
) -> None:
    assert change[0] in REAL
    with pytest.raises(InputRefused, match=sentence) as refused:
        load(tmp_path, REAL.replace(*change))
    assert "\n" not in str(refused.value)


def test_options_of_a_driver_may_stand_in_a_table_of_its_own(tmp_path: Path) -> None:
    table = "[scale.heidenhain-nd]\ntimeout_s = 2.5\n[servo]\nprofile"
    settings = load(tmp_path, REAL.replace("[servo]\nprofile", table))
    assert settings.scale is not None
    assert settings.scale.options == HeidenhainSettings(
        url="serial:///dev/ttyUSB0?baud=9600&format=7E2", timeout_s=2.5
    )


def test_every_relative_path_counts_from_the_folder_of_the_station_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = """
        [service]
        database = "kept/station.db"
        [backup]
        folder = "backups"
        [emulated]
        rig = "rig.toml"
        [openid]
        issuer = "https://login.example"
        client_id = "station"
        client_secret_file = "client"
        roles = {it = "administrator"}
        [[outbox.webhook]]
        url = "https://mes.example"
        secret_file = "secret"
        [[outbox.folder]]
        path = "../results"
        [[outbox.folder]]
        path = "/srv/results"
    """
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path)
    (tmp_path / "here" / "station.toml").write_text(text)
    settings = load_settings(Path("here/station.toml"))
    assert settings.openid is not None
    assert database_path(settings, tmp_path) == tmp_path / "here" / "kept" / "station.db"
    assert backup_folder(settings, tmp_path) == tmp_path / "here" / "backups"
    assert settings.emulated.rig == tmp_path / "here" / "rig.toml"
    assert settings.openid.client_secret_file == tmp_path / "here" / "client"
    assert settings.outbox.webhook[0].secret_file == tmp_path / "here" / "secret"
    assert [folder.path for folder in settings.outbox.folder] == [
        tmp_path / "here" / ".." / "results",
        Path("/srv/results"),
    ]


@pytest.mark.parametrize(
    ("receiver", "shown"),
    [
        ("[[outbox.mqtt]]\nurl = 'mqtts://a:hu@sh hush@b'\ntopic = 'x'", "'mqtts://***@b'"),
        ("[[outbox.webhook]]\nurl = 'https://mes /a?sig=hush'\nsecret_file = 'x'", r"'https://mes /a?***'"),
    ],
)
def test_a_refused_address_is_shown_without_its_secrets(tmp_path: Path, receiver: str, shown: str) -> None:
    with pytest.raises(InputRefused) as refused:
        load(tmp_path, receiver)
    assert f"(given: {shown})" in str(refused.value) and "hush" not in str(refused.value)


def test_a_path_that_is_given_without_a_file_stays() -> None:
    assert FolderSettings(path=Path("results")).path == Path("results")


def test_half_a_machine_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputRefused, match="belong together"):
        load(tmp_path, '[scale]\nprotocol = "heidenhain-nd"\nurl = "socket://localhost:1"\n')


def test_a_file_that_is_not_there_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputRefused, match="cannot be read"):
        load_settings(tmp_path / "none.toml")


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (("heidenhain-nd", "abacus"), r'\[scale\]: protocol "abacus" does not exist; there is heidenhain-nd'),
        (
            ("leadshine-el7", "mule"),
            r'\[servo\]: profile "mule" does not exist; there is leadshine-cs2rs, leadshine-el7',
        ),
        (("format=7E2", "format=9X9"), "9X9"),
        (("modbus+rtu:", "modbus+smoke:"), r"must begin with modbus\+rtu:"),
    ],
)
def test_devices_that_cannot_be_made_are_refused(
    tmp_path: Path, change: tuple[str, str], sentence: str
) -> None:
    with pytest.raises(InputRefused, match=sentence):
        build_devices(load(tmp_path, REAL.replace(*change)))


def test_the_home_folder_is_the_option_then_the_environment(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("STATION_HOME", str(tmp_path / "env"))
    assert station_home(tmp_path / "option") == tmp_path / "option"
    assert station_home(None) == tmp_path / "env"
    monkeypatch.delenv("STATION_HOME")
    assert station_home(None).name == "fivebar-station"
