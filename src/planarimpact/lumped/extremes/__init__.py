"""Extremes of the lumped model: a reader of its physics need not enter.

`scaling` admits groups of any size, `many_phases` skips thousands of phases.
"""
