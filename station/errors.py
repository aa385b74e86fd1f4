"""Errors whose text is meant for a person."""


class InputRefused(Exception):
    """What was given cannot be used: one sentence that says what, where and what to do."""
