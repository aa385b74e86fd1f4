"""What it costs to try a password."""

from __future__ import annotations

import runpy

from station.people import passwords


def test_a_password_costs_what_rfc_9106_recommends() -> None:
    """Its second recommended option, for computers with little memory."""
    fresh = runpy.run_path(str(passwords.__file__))  # other tests make it cheap
    assert fresh["hashed_password"]("correct horse").startswith("$argon2id$v=19$m=65536,t=3,p=4$")
    assert fresh["hashed_pin"]("1234").startswith("$argon2id$v=19$m=65536,t=3,p=4$")
