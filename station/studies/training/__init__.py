"""Unseen effects at the training desk, worked through as a trainee would."""
