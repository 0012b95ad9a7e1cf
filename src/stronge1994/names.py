"""Names of models in tables of curves, and which names figures and scenes have."""

import re

# Continua that lose energy by relaxation, with one time in shear and compression, or by yield.
CONTINUA = ("continuum.viscous", "continuum.plastic")
# All models that are compared with measurements below e = 1, that of the paper first.
PAPER = "lumped.hysteretic"
MODELS = (PAPER, "lumped.unloading-stiffness", "lumped.viscous", *CONTINUA[::-1])
STRONGE = "stronge1994"  # the source of what the paper states and prints
ELASTIC = "continuum"  # without loss
# The printed equations, as far as they differ from the lumped model; and the variant that has the
# places where they have no solution, with the answers of that model.
PRINTED, NO_SOLUTION = "printed", "no solution"
SCENE = "scene_"  # before the name of a scene, among what is judged


def home(figure: str) -> str:
    """Name of the package that has the folder of a figure.

    >>> home("fig5"), home("rod")
    ('figures', 'studies')
    """
    return "figures" if is_of_paper(figure) else "studies"


def is_of_paper(figure: str) -> bool:
    """Whether a figure is one of Figs 2 to 9 of the paper."""
    return re.fullmatch("fig[2-9]", figure) is not None
