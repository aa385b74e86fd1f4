"""What the plans promise and what comes of it, on emulated machines drawn from the tolerances."""
