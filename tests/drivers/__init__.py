"""Drivers against literal bytes, and against the emulated rig."""
