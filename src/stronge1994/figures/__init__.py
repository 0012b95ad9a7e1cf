"""The figures, a folder each: figure.yaml states, curves.py solves, drawing.py draws."""
