"""The figures, a folder each: figure.yaml states, curves.py solves, drawing.py draws.

If there is a slide.py, it draws one point of the figure for a projector.
"""
