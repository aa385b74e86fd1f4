"""Errors whose text is meant for a person."""


class InputRefused(Exception):
    """What was given cannot be used: one sentence that says what, where and what to do."""


class FieldRefused(InputRefused):
    """The same of one field of a request, `targets.3.approach1` for instance."""

    def __init__(self, field: str, text: str) -> None:
        super().__init__(text)
        self.field = field


class NotFound(Exception):
    """Nothing is kept under this number or serial."""


class Busy(Exception):
    """Another run holds the rig."""

    def __init__(self, calibration_id: int) -> None:
        super().__init__(f"Run {calibration_id} holds the rig; wait for its end or abort it.")
        self.calibration_id = calibration_id


class NotApplicable(Exception):
    """The zero offsets of a run cannot be written to the drives, or not taken back; says why."""


class KeyReused(Exception):
    """An idempotency key came again with another request."""

    def __init__(self, calibration_id: int) -> None:
        super().__init__(
            f"This idempotency key already belongs to run {calibration_id} with another request."
        )
        self.calibration_id = calibration_id


class NotSignedIn(Exception):
    """Whoever asks is not known, or not any more; says why."""


class Forbidden(Exception):
    """Whoever asks is known but may not do this; names the roles that may."""


class TooManyTries(Exception):
    """Too many failed sign-ins; the next is looked at after `after_s`."""

    def __init__(self, after_s: float) -> None:
        super().__init__(f"Too many failed sign-ins; wait {after_s:.0f} s.")
        self.after_s = after_s


class StoreUnavailable(Exception):
    """The database cannot be read or written at this moment; says why."""


class StepFailed(Exception):
    """A stop could not be measured; one sentence that names it."""


def sentence(text: str) -> str:
    """With a capital letter, the rest as it is."""
    return text[:1].upper() + text[1:]
