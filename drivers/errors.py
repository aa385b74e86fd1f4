"""Errors of devices."""

from __future__ import annotations


class DeviceError(Exception):
    """A device did not carry out a request; the text is one clear sentence for the operator."""


class LinkLost(DeviceError):
    """Nothing answers on the line: cable, power or address."""


class GarbledReply(DeviceError):
    """An answer violates the protocol (length, check sum, format)."""


class DeviceFault(DeviceError):
    """The device works and reports its own fault: alarm, signal loss, refused command."""
