"""The calibration station: kinematics, identification, diagnosis, orchestration and store."""

import os

__version__ = "0.2.0"

# Matrices here have a dozen columns: passing them to threads takes longer than multiplying them, three times
# as long if the cores are shared. It must be set before numpy is loaded; an existing setting is respected.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
