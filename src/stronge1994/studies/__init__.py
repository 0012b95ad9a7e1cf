"""Figures beyond the paper, a folder each, as in `figures`; an own figure belongs here."""
