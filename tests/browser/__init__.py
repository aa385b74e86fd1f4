"""The page in a browser, against the real service on the emulated rig."""
