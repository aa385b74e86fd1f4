"""Histories as large as those of a plant, and what the station does with them."""

from __future__ import annotations
