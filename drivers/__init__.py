"""Wire-true drivers for linear-scale readouts and servo drives, and the emulated rig."""
