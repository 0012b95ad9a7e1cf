"""Codes that solve the same problems a second time and make tables of data/; they share nothing
with the solver."""
