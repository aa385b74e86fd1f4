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
from station.credentials import without_credentials
from station.errors import InputRefused
from station.interlock_settings import InterlockSettings
from station.records import EventType, ScaleCertificate, content_of, said, sections_of_toml

Finite = Annotated[float, Field(allow_inf_nan=False)]


def _beside_the_station_file(path: Path, info: ValidationInfo) -> Path:
    folder: Path | None = info.context  # None if the settings are not from a file
    return path if folder is None else folder / path


NamedPath = Annotated[Path, AfterValidator(_beside_the_station_file)]
"""A relative path starts at the folder of the station file, wherever the station is started."""


class _Section(StrictNumbers):
    model_config = ConfigDict(extra="forbid", frozen=True)


class ScaleSettings(_Section):
    """`[scale]`: the readout of the linear scale. All options except `protocol` belong to its driver."""

    protocol: str
    """Name of the driver; see the sections of the drivers below."""
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
    """`[[servo.joint]]`: one drive, and the conversion of its pulses into a joint angle."""

    unit: Annotated[int, Field(ge=1, le=247)]
    """Address of the drive on its line."""
    sign: Annotated[int, Field(ge=-1, le=1, multiple_of=1)] = 1
    """1 if the joint angle increases with the pulses of the drive, else -1."""
    zero_at_deg: Finite
    """Joint angle at the zero of the drive."""
    counts_per_rev: Annotated[int, Field(gt=0)] = 10_000
    """Pulses per revolution of the motor."""
    ratio: Annotated[float, Field(gt=0, allow_inf_nan=False)] = 20.0
    """Revolutions of the motor per revolution of the joint."""
    reach_deg: Annotated[float, Field(gt=0, le=180)] = 60.0
    """Largest distance of a commanded joint angle from `zero_at_deg`."""

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
    """`[servo]`: the line of the two drives.  All options but `profile` and `joint` belong to their
    driver."""

    profile: str
    """Name of the driver; see the sections of the drivers below."""
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
    """`[limits]`: motion of the machine, and conditions for a valid reading."""

    speed_deg_s: Annotated[float, Field(gt=0, le=180)] = 30.0
    """Speed of every motion of a joint."""
    workspace_margin_mm: Annotated[float, Field(ge=0, le=50)] = 5.0
    """Largest distance of a measuring position outside the workspace."""
    swing_mm: Annotated[float, Field(ge=0, le=200)] = 80.0
    """Largest distance outside the workspace during a motion, including the effect of zero offsets that
    are not yet known."""
    settle_s: Annotated[float, Field(ge=0, le=10)] = 0.3
    """Longest wait after standstill for samples that agree within `settled_mm`; after it, samples within
    `scale_spread_mm` are accepted."""
    settled_mm: Annotated[float, Field(ge=0, le=1)] = 0.006
    """Largest difference between samples that agree: the arm has settled."""
    samples: Annotated[int, Field(ge=2, le=100)] = 5
    """Number of samples of the scale in one reading."""
    scale_spread_mm: Annotated[float, Field(gt=0, le=1)] = 0.05
    """Largest difference between the samples of one reading."""
    feedback_deg: Annotated[float, Field(gt=0, le=1)] = 0.05
    """Largest difference between the feedback and the command."""
    corridor_deg: Annotated[float, Field(gt=0, le=10)] = 2.0
    """Largest deviation of a moving joint from its path between start and target."""
    overshoot_deg: Annotated[float, Field(gt=0, le=5)] = 0.5
    """Length of the run-up to a position that must be approached from a given side."""
    prompt_s: Annotated[float, Field(gt=0, le=86400)] = 300.0
    """Longest wait for an answer to a question of a run, in real time; then the machine is made safe and
    the run ends."""
    level_sd_deg: Annotated[float, Field(gt=0, le=1)] = 0.005
    """Standard uncertainty of an angle read from a level, for plan `reference`."""
    check_valid_h: Annotated[float, Field(gt=0, le=8760)] = 24.0
    """Validity of a passed check, hours."""
    travel_error_mm: Annotated[float, Field(gt=0, le=500)] = 60.0
    """Largest difference between the travel of the scale and the travel computed from the joints."""


class ServiceSettings(_Section):
    """`[service]`: addresses, files and limits of the page and the REST interface."""

    host: str = "127.0.0.1"
    """Address to listen on; `0.0.0.0`: all addresses of this computer."""
    port: Annotated[int, Field(ge=0, le=65535)] = 8000
    """Port to listen on; 0: any free port."""
    database: NamedPath | None = None
    """File of the history; by default `station.db` in the data folder."""
    least_free_mb: Annotated[float, Field(ge=0, le=1e6)] = 4.0
    """Least free space on the disk of the history, MB; with less, no run starts."""
    open: bool = True
    """If true, the emulated rig on a loopback address needs no sign-in. Every other station always needs
    one."""
    hosts: tuple[Annotated[str, Field(pattern=r"^[A-Za-z0-9.\-:\[\]]+$")], ...] = ()
    """Names under which browsers reach the station, for example `station.plant.example`, also with
    `:port`; its own address and the loopback addresses are always accepted."""
    trusted_proxies: tuple[IPvAnyNetwork, ...] = ()
    """Addresses or networks of reverse proxies whose `X-Forwarded-` headers are trusted."""
    sign_off_min: Annotated[float, Field(gt=0, le=1440)] = 60.0
    """Minutes without activity after which a user is signed off, but never during a run."""
    body_mb: Annotated[float, Field(gt=0, le=100)] = 4.0
    """Largest file in a request, MB; the limit for JSON is 1 MB."""


class BackupSettings(_Section):
    """`[backup]`: copies of the history that the station makes automatically."""

    every_h: Annotated[float, Field(gt=0, le=8760)] | None = None
    """Hours between two backups; without it, backups are made only on request."""
    folder: NamedPath | None = None
    """Folder of the backups, preferably on another disk; by default `backups` in the data folder."""
    keep: Annotated[int, Field(ge=1, le=10_000)] = 14
    """Number of backups that are kept; older ones are deleted, with an event."""


class RetentionSettings(_Section):
    """`[retention]`: data that are deleted from the history after some time.  Readings and results are
    never deleted."""

    samples_days: Annotated[float, Field(ge=1)] | None = None
    """Days after the end of a run until the single samples of its readings are deleted, with an event; their
    mean and number are kept.  Without it, the samples are kept."""
    wire_days: Annotated[float, Field(ge=1)] | None = None
    """Days after the end of a run until its wire log is deleted, with an event.  Without it, wire logs are
    kept."""


class QualitySettings(_Section):
    """`[quality]`: process limits with which finished runs are compared."""

    zero_offset_deg: Annotated[float, Field(gt=0, le=90)] = 3.0
    """Process limit of the zero offsets, in both directions."""
    position_error_mm: Annotated[float, Field(gt=0, le=1000)] = 0.5
    """Process limit of the position error (95 % bound over the workspace)."""
    runs: Annotated[int, Field(ge=3, le=100_000)] = 1000
    """Number of the newest finished runs that are evaluated."""


def _pattern(text: str) -> str:
    try:
        re.compile(text, re.ASCII)
    except re.error as error:
        raise ValueError(f"is no regular expression: {error}") from error
    if re.search(r"\(\?(?!:)|\\[AZ]", text):
        raise ValueError("may group with ( ) and (?: ), but use no other (?...), \\A or \\Z")
    return text


Pattern = Annotated[str, Field(min_length=1, max_length=200), AfterValidator(_pattern)]
"""A regular expression of the whole text with the same meaning in Python and in the page."""


class ScanSettings(_Section):
    """`[scan]`: codes of barcode scanners at the page.  A pattern must match the whole code; it is
    compared first with the code that confirms, then with a badge, then with a serial number."""

    serial: Pattern = r"[A-Za-z0-9][A-Za-z0-9._/-]{0,63}"
    """Regular expression of the serial number of a robot."""
    badge: Pattern = r"BADGE:(.{1,64})"
    """Regular expression of a badge.  At a station without sign-in, its first group, else the whole text,
    is the name of the operator."""
    confirm: Annotated[str, Field(pattern=r"^[!-~]{3,64}$")] = "CONFIRM"
    """The code that confirms an action which waits for confirmation."""

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
    """`[[outbox.webhook]]`: an address to which events are posted, signed as in Standard Webhooks."""

    url: Annotated[str, Field(pattern=r"^https?://[^\s@]+$")]
    """`https://...`; `http` only to this computer."""
    secret_file: NamedPath
    """File with the secret: `whsec_` and base64 of at least 24 bytes."""
    events: EventTypes = ("run.ended", "alarm")
    """Types of events that are sent."""

    @model_validator(mode="after")
    def _plain_to_loopback_only(self) -> Self:
        _refuse_plain_http(self.url)
        return self


class MqttSettings(_Section):
    """`[[outbox.mqtt]]`: an MQTT 5 broker."""

    url: Annotated[str, Field(pattern=r"^mqtts?://\S+$")]
    """`mqtt://host:1883` or `mqtts://name:password@host:8883`."""
    topic: Annotated[str, Field(min_length=1, max_length=200, pattern=r"^[^+#\x00]+$")]
    """Beginning of all topics of this station: `TOPIC/events/TYPE` and `TOPIC/state`."""
    events: EventTypes = ("run.ended", "alarm")
    """Types of events that are sent."""


class FolderSettings(_Section):
    """`[[outbox.folder]]`: a folder in which each event is written as a file."""

    path: NamedPath
    """Path of the folder; it is created if it does not exist."""
    format: Literal["json", "csv"] = "json"
    """Format of the files."""
    events: EventTypes = ("run.ended", "alarm")
    """Types of events that are written."""


class OpenIdSettings(_Section):
    """`[openid]`: the OpenID Connect provider of the plant; its users can sign in, in addition to those of
    the station."""

    label: Annotated[str, Field(min_length=1, max_length=40)] = "OpenID Connect"
    """Name of the provider on the sign-in page."""
    issuer: Annotated[str, Field(pattern=r"^https?://[^\s@?#]+$")]
    """`https://...`, exactly as the provider states it; `http` only to this computer."""
    client_id: Annotated[str, Field(min_length=1, max_length=200)]
    """Client id of this station at the provider."""
    client_secret_file: NamedPath | None = None
    """File with the secret of the client; without it, the client is public and only PKCE protects the
    code."""
    scope: Annotated[str, Field(pattern=r"^openid( \S+)*$")] = "openid profile"
    """Requested scopes; `openid` must be the first."""
    name_claim: Annotated[str, Field(min_length=1)] = "preferred_username"
    """Claim with the name of the user at the station."""
    role_claim: Annotated[str, Field(min_length=1)] = "groups"
    """Claim (text or list) whose values determine the role; `realm_access.roles` is `roles` inside
    `realm_access`."""
    roles: Annotated[
        dict[str, Literal["viewer", "operator", "engineer", "administrator"]], Field(min_length=1)
    ]
    """Role for each value of this claim.  Of several roles, the one with most permissions applies; without
    a role, the user cannot sign in."""

    @model_validator(mode="after")
    def _plain_to_loopback_only(self) -> Self:
        _refuse_plain_http(self.issuer)
        return self


class ScaleCertificateSettings(StrictNumbers, ScaleCertificate):
    """`[scale_certificate]`: the calibration certificate of the linear scale.  Outside its dates, no run
    passes."""

    model_config = ConfigDict(extra="forbid")


class OutboxSettings(_Section):
    """`[outbox]`: receivers of events on runs and alarms."""

    keep_days: Annotated[float, Field(gt=0, le=3650)] = 7.0
    """Days of failed attempts after which an event is no longer sent; it is shown as `expired`."""
    keep: Annotated[int, Field(ge=1, le=10_000_000)] = 100_000
    """Largest number of events that wait for one receiver; if there are more, the oldest are discarded."""
    webhook: tuple[WebhookSettings, ...] = ()
    mqtt: tuple[MqttSettings, ...] = ()
    folder: tuple[FolderSettings, ...] = ()


class EmulatedSettings(_Section):
    """`[emulated]`: the emulated machine, which is used if no devices are declared."""

    rig: NamedPath | None = None
    """Rig file; by default, group 1 of the paper."""
    speed: Annotated[float, Field(gt=0, le=1000)] = 50.0
    """Speed factor relative to real time."""


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
    if isinstance(given, str) and loc[0] == "outbox":
        given = without_credentials(given)
    value = f" (given: {given!r})" if not isinstance(given, dict) else ""
    return f"{where}: {message}{value}.".removeprefix(": ")


def backup_folder(settings: Settings, home: Path) -> Path:
    """Folder of the station's own backups: `[backup] folder`, otherwise in the home folder."""
    return settings.backup.folder or home / "backups"


def database_path(settings: Settings, home: Path) -> Path:
    """File of the store: the station file's `[service] database`, otherwise in the home folder."""
    return settings.service.database or home / "station.db"
