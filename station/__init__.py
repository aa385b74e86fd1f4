"""The calibration station: kinematics, identification, diagnosis, orchestration and store."""

__version__ = "0.1.0"
