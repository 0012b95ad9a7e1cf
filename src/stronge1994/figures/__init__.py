"""Figs 2 to 9, a folder each: figure.yaml states, curves.py solves, drawing.py draws."""
