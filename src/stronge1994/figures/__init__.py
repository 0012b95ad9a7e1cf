"""The figures: a folder each, with what it solves, `curves.py`, and draws, `drawing.py`."""
