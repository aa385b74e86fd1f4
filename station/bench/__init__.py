"""`station bench`: how fast and how small, peers measured in the same run."""
