"""The documentation: its code runs, its links work, its reference is up to date."""
