"""How devices fail."""

from __future__ import annotations


class DeviceError(Exception):
    """A device did not do what was asked; the text is one clear sentence for the operator."""


class LinkLost(DeviceError):
    """Nothing answers on the line: cable, power or address."""


class GarbledReply(DeviceError):
    """Something answered, but not what the protocol allows (length, check sum, format)."""


class DeviceFault(DeviceError):
    """The device works and reports a fault of its own: alarm, signal loss, refused command."""
