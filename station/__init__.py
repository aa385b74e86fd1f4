"""The calibration station: kinematics, identification, diagnosis, orchestration and store."""

import os

__version__ = "0.2.0"

# Matrices here have a dozen columns: handing them to threads takes longer than multiplying them, three
# times as long where the cores are shared.  Must be said before numpy is loaded; who has said otherwise wins.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
