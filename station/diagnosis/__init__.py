"""Closing the loop: residual, cause, model, before and after (method.md section 3)."""
