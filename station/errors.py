"""Errors whose text is meant for a person."""


class InputRefused(Exception):
    """The input cannot be used: one sentence with the error, its location and the remedy."""


class FieldRefused(InputRefused):
    """The same for one field of a request, for instance `targets.3.approach1`."""

    def __init__(self, field: str, text: str) -> None:
        super().__init__(text)
        self.field = field


class NotFound(Exception):
    """No entry has this number or serial."""


class Busy(Exception):
    """Another run holds the rig."""

    def __init__(self, calibration_id: int) -> None:
        super().__init__(f"Run {calibration_id} holds the rig; wait for its end or abort it.")
        self.calibration_id = calibration_id


class NotApplicable(Exception):
    """The zero offsets of a run cannot be written to the drives, or not rolled back; with the reason."""


class KeyReused(Exception):
    """An idempotency key was used again for another request."""

    def __init__(self, calibration_id: int) -> None:
        super().__init__(
            f"This idempotency key already belongs to run {calibration_id} with another request."
        )
        self.calibration_id = calibration_id


class NotSignedIn(Exception):
    """The author of a request is unknown, or no longer signed in; with the reason."""


class Forbidden(Exception):
    """The author of a request has no permission; the error names the roles that have it."""


class TooManyTries(Exception):
    """Too many failed sign-ins; the next one is possible after `after_s`."""

    def __init__(self, after_s: float) -> None:
        super().__init__(f"Too many failed sign-ins; wait {after_s:.0f} s.")
        self.after_s = after_s


class StoreUnavailable(Exception):
    """The database cannot be read or written now; with the reason."""


class StepFailed(Exception):
    """A stop could not be measured; one sentence that names it."""


def sentence(text: str) -> str:
    """The text with a capital first letter."""
    return text[:1].upper() + text[1:]
