"""The station file (TOML) and the data folder, checked before anything is opened."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Literal, Self
from urllib.parse import urlsplit

from pydantic import (
    AfterValidator,
    ConfigDict,
    Field,
    IPvAnyNetwork,
    JsonValue,
    SerializeAsAny,
    ValidationError,
    ValidationInfo,
    model_validator,
)
from pydantic_core import ErrorDetails

from drivers.driver import DriverSettings
from drivers.scaling import JointScaling
from drivers.strict_numbers import StrictNumbers
from station.errors import InputRefused
from station.interlock_settings import InterlockSettings
from station.records import EventType, ScaleCertificate, content_of, said, sections_of_toml

Finite = Annotated[float, Field(allow_inf_nan=False)]


def _beside_the_station_file(path: Path, info: ValidationInfo) -> Path:
    folder: Path | None = info.context  # None if the settings are not from a file
    return path if folder is None else folder / path


NamedPath = Annotated[Path, AfterValidator(_beside_the_station_file)]
"""A relative path is relative to the folder of the station file, wherever the station is started."""


class _Section(StrictNumbers):
    model_config = ConfigDict(extra="forbid", frozen=True)


class ScaleSettings(_Section):
    """`[scale]`: the readout of the linear scale. All options except `protocol` belong to its driver."""

    protocol: str
    """Name of the driver: see the sections of the drivers below."""
    options: SerializeAsAny[DriverSettings]

    @model_validator(mode="before")
    @classmethod
    def _options_of_its_driver(cls, data: Any) -> Any:
        # Imported here: drivers load serial and Modbus libraries, which only a file with devices needs.
        from drivers.scales import SCALES

        return _with_options(data, "protocol", {name: driver.settings for name, driver in SCALES.items()})

    def flat(self) -> dict[str, JsonValue]:
        """The section as in the station file, with every option."""
        return {"protocol": self.protocol, **self.options.model_dump(mode="json")}


class JointSettings(_Section):
    """`[[servo.joint]]`: one drive and the conversion of its pulses to a joint angle."""

    unit: Annotated[int, Field(ge=1, le=247)]
    """Address of the drive on its line."""
    sign: Annotated[int, Field(ge=-1, le=1, multiple_of=1)] = 1
    """1 if the joint angle increases with the pulses of the drive, otherwise -1."""
    zero_at_deg: Finite
    """Joint angle at the zero of the drive."""
    counts_per_rev: Annotated[int, Field(gt=0)] = 10_000
    """Pulses per revolution of the motor."""
    ratio: Annotated[float, Field(gt=0, allow_inf_nan=False)] = 20.0
    """Revolutions of the motor per revolution of the joint."""
    reach_deg: Annotated[float, Field(gt=0, le=180)] = 60.0
    """Range of the joint's commands, to either side of `zero_at_deg`."""

    @model_validator(mode="after")
    def _sign_is_a_sign(self) -> Self:
        if self.sign == 0:
            raise ValueError("sign must be 1 or -1")
        return self

    @property
    def scaling(self) -> JointScaling:
        return JointScaling(self.counts_per_rev, self.ratio, self.zero_at_deg, self.sign)


DEFAULT_JOINTS = (JointSettings(unit=1, zero_at_deg=0.0), JointSettings(unit=2, zero_at_deg=180.0))


class ServoSettings(_Section):
    """`[servo]`: the line of the two drives. All options except `profile` and `joint` are the driver's."""

    profile: str
    """Name of the driver: see the sections of the drivers below."""
    options: SerializeAsAny[DriverSettings]
    joint: tuple[JointSettings, JointSettings] = DEFAULT_JOINTS

    @model_validator(mode="before")
    @classmethod
    def _options_of_their_driver(cls, data: Any) -> Any:
        from drivers.servos import SERVOS  # imported here, as for the scale

        known = {name: driver.settings for name, driver in SERVOS.items()}
        return _with_options(data, "profile", known, own=("joint",))

    def flat(self) -> dict[str, JsonValue]:
        """The section as in the station file, with every option."""
        joints = [joint.model_dump(mode="json") for joint in self.joint]
        return {"profile": self.profile, "joint": joints, **self.options.model_dump(mode="json")}

    @model_validator(mode="after")
    def _drives_differ(self) -> Self:
        if self.joint[0].unit == self.joint[1].unit:
            raise ValueError("the two joints must have different units")
        return self


def _with_options(
    data: Any, choice: str, known: Mapping[str, type[DriverSettings]], own: tuple[str, ...] = ()
) -> Any:
    """A section whose further options, also those in a table named after the driver, are `options`."""
    if not isinstance(data, dict) or "options" in data or not isinstance(name := data.get(choice), str):
        return data
    if name not in known:
        raise ValueError(f'{choice} "{name}" does not exist; there is {", ".join(sorted(known))}')
    options = {key: value for key, value in data.items() if key not in (choice, name, *own)}
    table = data.get(name, {})
    if not isinstance(table, dict):
        raise ValueError(f"{name} must be a table")
    section = {key: value for key, value in data.items() if key in (choice, *own)}
    return {**section, "options": known[name].model_validate(options | table)}


class LimitSettings(_Section):
    """`[limits]`: limits of motion and conditions for a valid reading."""

    speed_deg_s: Annotated[float, Field(gt=0, le=180)] = 30.0
    """Speed of every motion of a joint."""
    workspace_margin_mm: Annotated[float, Field(ge=0, le=50)] = 5.0
    """How far outside the workspace a stop may lie."""
    swing_mm: Annotated[float, Field(ge=0, le=200)] = 80.0
    """How far outside it the arm may swing during motion, unknown zero offsets included."""
    settle_s: Annotated[float, Field(ge=0, le=10)] = 0.3
    """Longest wait after standstill for samples that agree; then `scale_spread_mm` is sufficient."""
    settled_mm: Annotated[float, Field(ge=0, le=1)] = 0.006
    """Samples within this of each other agree: the arm is at rest."""
    samples: Annotated[int, Field(ge=2, le=100)] = 5
    """Samples of the scale in one reading."""
    scale_spread_mm: Annotated[float, Field(gt=0, le=1)] = 0.05
    """Largest minus smallest sample of one reading."""
    feedback_deg: Annotated[float, Field(gt=0, le=1)] = 0.05
    """Allowed difference between feedback and command."""
    corridor_deg: Annotated[float, Field(gt=0, le=10)] = 2.0
    """Allowed deviation of a moving joint from the path between its start and its target."""
    overshoot_deg: Annotated[float, Field(gt=0, le=5)] = 0.5
    """Run-up of a stop that must be approached from a given side."""
    prompt_s: Annotated[float, Field(gt=0, le=86400)] = 300.0
    """How long a run waits for an answer, in real time; then the machine is made safe and the run ends."""
    level_sd_deg: Annotated[float, Field(gt=0, le=1)] = 0.005
    """Standard uncertainty of a level on a link, for plan `reference`."""
    check_valid_h: Annotated[float, Field(gt=0, le=8760)] = 24.0
    """Validity of a passed check, hours."""
    travel_error_mm: Annotated[float, Field(gt=0, le=500)] = 60.0
    """Allowed difference between the scale's travel and that computed from the joints."""


class ServiceSettings(_Section):
    """`[service]`: address and limits of the page and the REST interface."""

    host: str = "127.0.0.1"
    """Address to listen at; `0.0.0.0` is every address of this computer."""
    port: Annotated[int, Field(ge=0, le=65535)] = 8000
    """Port to listen at; 0 selects a free one."""
    database: NamedPath | None = None
    """File of the history; by default `station.db` in the home folder."""
    least_free_mb: Annotated[float, Field(ge=0, le=1e6)] = 4.0
    """Minimum free space on the disk of the history for a run to start, MB."""
    open: bool = True
    """Whether the emulated rig on a loopback address needs no sign-in; any other station always needs one."""
    hosts: tuple[Annotated[str, Field(pattern=r"^[A-Za-z0-9.\-:\[\]]+$")], ...] = ()
    """Names under which browsers reach the station, as `station.plant.example` or with `:port`; its own
    listening address and the loopback addresses are always included.
    """
    trusted_proxies: tuple[IPvAnyNetwork, ...] = ()
    """Addresses or networks of reverse proxies whose `X-Forwarded-` headers are accepted."""
    sign_off_min: Annotated[float, Field(gt=0, le=1440)] = 60.0
    """Minutes without activity after which a user is signed off, but never while a run is active."""
    body_mb: Annotated[float, Field(gt=0, le=100)] = 4.0
    """Largest file in a request, MB; JSON may have 1 MB."""


class BackupSettings(_Section):
    """`[backup]`: automatic copies of the history."""

    every_h: Annotated[float, Field(gt=0, le=8760)] | None = None
    """Hours between backups; by default only on request."""
    folder: NamedPath | None = None
    """Folder for backups, preferably on another disk; by default `backups` in the home folder."""
    keep: Annotated[int, Field(ge=1, le=10_000)] = 14
    """Number of newest backups that are retained; older ones are deleted, with an event."""


class RetentionSettings(_Section):
    """`[retention]`: automatic deletion from the history. Readings and results are never deleted."""

    samples_days: Annotated[float, Field(ge=1)] | None = None
    """Days after the end of a run after which the single samples of its readings are deleted, with an event;
    their mean and number remain. By default they are kept.
    """
    wire_days: Annotated[float, Field(ge=1)] | None = None
    """Days after the end of a run after which its wire log is deleted, with an event. By default it is
    kept.
    """


class QualitySettings(_Section):
    """`[quality]`: limits of process control for finished runs."""

    zero_offset_deg: Annotated[float, Field(gt=0, le=90)] = 3.0
    """Largest zero offset, to either side, within the process limits."""
    position_error_mm: Annotated[float, Field(gt=0, le=1000)] = 0.5
    """Largest position error, 95 % bound over the workspace, within the process limits."""
    runs: Annotated[int, Field(ge=3, le=100_000)] = 1000
    """Number of newest finished runs that are evaluated."""


def _pattern(text: str) -> str:
    try:
        re.compile(text, re.ASCII)
    except re.error as error:
        raise ValueError(f"is no regular expression: {error}") from error
    if re.search(r"\(\?(?!:)|\\[AZ]", text):
        raise ValueError("may group with ( ) and (?: ), but use no other (?...), \\A or \\Z")
    return text


Pattern = Annotated[str, Field(min_length=1, max_length=200), AfterValidator(_pattern)]
"""A regular expression for the whole text that works identically in Python and in the page."""


class ScanSettings(_Section):
    """`[scan]`: codes of barcode scanners at the page. A code must match its pattern as a whole; the
    confirming code is tested first, then a badge, then a serial number.
    """

    serial: Pattern = r"[A-Za-z0-9][A-Za-z0-9._/-]{0,63}"
    """Regular expression of the serial number of a robot."""
    badge: Pattern = r"BADGE:(.{1,64})"
    """Regular expression of a badge. Its first group, otherwise the whole text, is the name of the operator
    if nobody signs in.
    """
    confirm: Annotated[str, Field(pattern=r"^[!-~]{3,64}$")] = "CONFIRM"
    """The code that confirms a pending confirmation."""

    @model_validator(mode="after")
    def _badge_does_not_confirm(self) -> Self:
        if re.fullmatch(self.badge, self.confirm, re.ASCII):
            raise ValueError("the code that confirms must not fit the pattern of a badge")
        return self


def _refuse_plain_http(url: str) -> None:
    host = urlsplit(url).hostname or ""
    if url.startswith("http:") and host not in ("127.0.0.1", "localhost", "::1"):
        raise ValueError("plain http goes to this computer only; use https")


EventTypes = tuple[EventType, ...]


class WebhookSettings(_Section):
    """`[[outbox.webhook]]`: an address that receives events by POST, signed as in Standard Webhooks."""

    url: Annotated[str, Field(pattern=r"^https?://[^\s@]+$")]
    """`https://...`; plain `http` to this computer only."""
    secret_file: NamedPath
    """File with the secret, `whsec_` and base64 of 24 bytes or more."""
    events: EventTypes = ("run.ended", "alarm")
    """Types of event that are sent."""

    @model_validator(mode="after")
    def _plain_to_loopback_only(self) -> Self:
        _refuse_plain_http(self.url)
        return self


class MqttSettings(_Section):
    """`[[outbox.mqtt]]`: a broker of MQTT 5."""

    url: Annotated[str, Field(pattern=r"^mqtts?://\S+$")]
    """`mqtt://host:1883` or `mqtts://name:password@host:8883`."""
    topic: Annotated[str, Field(min_length=1, max_length=200, pattern=r"^[^+#\x00]+$")]
    """Prefix of all topics of this station: `TOPIC/events/TYPE` and `TOPIC/state`."""
    events: EventTypes = ("run.ended", "alarm")
    """Types of event that are sent."""


class FolderSettings(_Section):
    """`[[outbox.folder]]`: a folder in which each event becomes a file."""

    path: NamedPath
    """Path of the folder; it is created if missing."""
    format: Literal["json", "csv"] = "json"
    """Format of the files."""
    events: EventTypes = ("run.ended", "alarm")
    """Types of event that are written."""


class OpenIdSettings(_Section):
    """`[openid]`: the plant's OpenID Connect provider, for people beside the station's users."""

    label: Annotated[str, Field(min_length=1, max_length=40)] = "OpenID Connect"
    """Name of the provider on the sign-in page."""
    issuer: Annotated[str, Field(pattern=r"^https?://[^\s@?#]+$")]
    """`https://...` as in the provider's own metadata; plain `http` to this computer only."""
    client_id: Annotated[str, Field(min_length=1, max_length=200)]
    """Identifier of this station at the provider."""
    client_secret_file: NamedPath | None = None
    """File with the secret of the client; without it the client is public and protected by PKCE only."""
    scope: Annotated[str, Field(pattern=r"^openid( \S+)*$")] = "openid profile"
    """Requested scopes; `openid` is the first."""
    name_claim: Annotated[str, Field(min_length=1)] = "preferred_username"
    """Claim with the name of the user in the station."""
    role_claim: Annotated[str, Field(min_length=1)] = "groups"
    """Claim, a text or a list, whose values decide the role; `a.b` is claim `b` inside `a`."""
    roles: Annotated[
        dict[str, Literal["viewer", "operator", "engineer", "administrator"]], Field(min_length=1)
    ]
    """Role by value of that claim. The role with most rights applies; without any, sign-in is refused."""

    @model_validator(mode="after")
    def _plain_to_loopback_only(self) -> Self:
        _refuse_plain_http(self.issuer)
        return self


class ScaleCertificateSettings(StrictNumbers, ScaleCertificate):
    """`[scale_certificate]`: the calibration of the linear scale. Outside its dates no run passes."""

    model_config = ConfigDict(extra="forbid")


class OutboxSettings(_Section):
    """`[outbox]`: receivers of events about runs and alarms."""

    keep_days: Annotated[float, Field(gt=0, le=3650)] = 7.0
    """Age in days after which an event is given up as `expired`, if all attempts in that time failed."""
    keep: Annotated[int, Field(ge=1, le=10_000_000)] = 100_000
    """Maximum number of events pending for one receiver; the oldest are given up first."""
    webhook: tuple[WebhookSettings, ...] = ()
    mqtt: tuple[MqttSettings, ...] = ()
    folder: tuple[FolderSettings, ...] = ()


class EmulatedSettings(_Section):
    """`[emulated]`: the machine used when no devices are named."""

    rig: NamedPath | None = None
    """Rig file; by default the paper's group 1."""
    speed: Annotated[float, Field(gt=0, le=1000)] = 50.0
    """Speed over real time."""


class Settings(_Section):
    """The whole station file; without one, the emulated rig."""

    name: str = "Five-bar station"
    """Shown at the top of the page."""
    scale: ScaleSettings | None = None
    servo: ServoSettings | None = None
    limits: LimitSettings = LimitSettings()
    interlocks: InterlockSettings = InterlockSettings()
    service: ServiceSettings = ServiceSettings()
    backup: BackupSettings = BackupSettings()
    retention: RetentionSettings = RetentionSettings()
    quality: QualitySettings = QualitySettings()
    scale_certificate: ScaleCertificateSettings | None = None
    scan: ScanSettings = ScanSettings()
    outbox: OutboxSettings = OutboxSettings()
    openid: OpenIdSettings | None = None
    emulated: EmulatedSettings = EmulatedSettings()

    @model_validator(mode="after")
    def _devices_come_together(self) -> Self:
        if (self.scale is None) != (self.servo is None):
            raise ValueError("[scale] and [servo] belong together: give both, or none for the emulated rig")
        return self

    @property
    def joints(self) -> tuple[JointSettings, JointSettings]:
        return self.servo.joint if self.servo is not None else DEFAULT_JOINTS


def load_settings(path: Path | None) -> Settings:
    """Read a station file; None gives the defaults.

    :raises InputRefused: one sentence naming section, option, bounds and value.
    """
    if path is None:
        return Settings()
    data = sections_of_toml(content_of(path, "Station file"), f"Station file {path}")
    try:
        return Settings.model_validate(data, context=path.absolute().parent)
    except ValidationError as error:
        raise InputRefused(f"Station file {path}: {_sentence(error.errors()[0])}") from error


def _sentence(error: ErrorDetails, inside: tuple[int | str, ...] = ()) -> str:
    loc = (*inside, *error["loc"])
    if isinstance(options := error.get("ctx", {}).get("error"), ValidationError):
        return _sentence(options.errors()[0], loc)
    *section, option = ["", *(str(part) for part in loc)]
    where = f"[{'.'.join(section[1:])}] {option}" if len(section) > 1 else f"[{option}]" if option else ""
    message = said(error)
    if error["type"] == "extra_forbidden":
        return f"{where} is not an option; check its spelling and section."
    if error["type"] == "missing":
        return f"{where} is missing."
    given = error["input"]
    value = f" (given: {given!r})" if not isinstance(given, dict) else ""
    return f"{where}: {message}{value}.".removeprefix(": ")


def backup_folder(settings: Settings, home: Path) -> Path:
    """Folder of the station's own backups: `[backup] folder`, otherwise in the home folder."""
    return settings.backup.folder or home / "backups"


def database_path(settings: Settings, home: Path) -> Path:
    """File of the store: the station file's `[service] database`, otherwise in the home folder."""
    return settings.service.database or home / "station.db"
