"""Extremes of the lumped model that a reader of its physics need not enter."""
