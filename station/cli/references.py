"""References and lengths as they are written on the command line: `joint=1,at=0.0,...`, `0.2mm`."""

from __future__ import annotations

import click
from pydantic import ValidationError

from station.records import AnyReference, JointAngle, MountingError, ReferenceUse, said

FORMS = "joint=1,at=0.0,reads=0.012,sd=0.005 or drm_x=1.02,sd=0.02"


def _reference(text: str) -> AnyReference:
    """:raises click.UsageError: it is no reference; says what one looks like."""
    pairs = [part.partition("=") for part in text.split(",")]
    given = {key.strip(): value.strip() for key, _, value in pairs}
    doubtful = len(given) < len(pairs) or not all(separator for _, separator, _ in pairs)
    try:
        if not doubtful and set(given) == {"joint", "at", "reads", "sd"}:
            return JointAngle.model_validate(
                {
                    "joint": int(given["joint"]),
                    "at_deg": given["at"],
                    "reads_deg": given["reads"],
                    "sd_deg": given["sd"],
                }
            )
        if not doubtful and len(given) == 2 and "sd" in given:
            kind = next(key for key in given if key != "sd")
            return MountingError.model_validate({"kind": kind, "value_mm": given[kind], "sd_mm": given["sd"]})
    except ValidationError as error:
        first = error.errors()[0]
        where = " ".join(str(part) for part in first["loc"])
        raise click.UsageError(f"--reference {text}: {where}: {said(first).lower()}.") from error
    except ValueError as error:
        raise click.UsageError(f"--reference {text}: joint must be 1 or 2.") from error
    raise click.UsageError(f"--reference {text} is not understood; write {FORMS}.")


def _references(
    _context: click.Context, _option: click.Parameter, given: tuple[str, ...]
) -> tuple[AnyReference, ...]:
    return tuple(_reference(text) for text in given)


references_option = click.option(
    "--reference",
    "references",
    multiple=True,
    callback=_references,
    help=f"Measurement of another instrument, in degrees and mm: {FORMS}.  Can be given several times.",
)


class _Length(click.ParamType[float]):
    """Millimetres, with or without the unit."""

    name = "length"

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> float:
        text = str(value).strip().removesuffix("mm").strip()
        try:
            length_mm = float(text)
        except ValueError:
            self.fail(f"{value} is not a length; write 0.2mm.", param, ctx)
        if not 0.0 < length_mm < float("inf"):
            self.fail(f"{value} must be above 0 mm.", param, ctx)
        return length_mm


LENGTH = _Length()


def reference_line(use: ReferenceUse) -> str:
    """A reference that took part, and how well it agrees, in a sentence."""
    if use.residual is None or use.p_value is None:
        return f"{use.reference.words}: no other measurement supports it."
    return (
        f"{use.reference.words}: {use.residual:+.4f} {use.unit} from the value of all other data,"
        f" standard uncertainty {use.sd or 0.0:.4f} (p = {use.p_value:.2g})."
    )
