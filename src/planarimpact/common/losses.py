"""What takes the normal energy of a contact where e < 1: one table for all models.

Code passes a `Loss`. An array of losses has the places of their `NAMES`, and -1 where there is
none. Names are for users and files. At e = 1 all losses of a model are the same.

A new loss of the lumped model is a new row, with its own `stiffness_ratio`, and its name in the
types below: solvers, models, collisions and messages follow. One of the continuum needs a motion
besides, see `planarimpact.continuum.inelastic`.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

# The names in `LUMPED`, `NONCOLLINEAR` and `SPHERES`, for type checkers.
LumpedLoss: TypeAlias = Literal["hysteretic", "unloading-stiffness", "viscous"]
NoncollinearLoss: TypeAlias = Literal["hysteretic", "unloading-stiffness"]
SpheresLoss: TypeAlias = Literal["viscous", "plastic"]
SpheresLosses: TypeAlias = SpheresLoss | Sequence[SpheresLoss | Literal[""] | None] | NDArray[Any]


@dataclass(frozen=True, eq=False)
class Loss:
    """A loss in one model.

    Examples
    --------
    >>> LUMPED["unloading-stiffness"].stiffness_ratio(1.0, 0.5)
    0.25
    """

    model: str  # "lumped" or "continuum"; "lumped.viscous" is one of `models.MODELS`
    name: Any  # one of the names above
    valid: str  # what it describes
    source: str  # the publication that it is taken from
    least_restitution: float = 0.0  # the solver takes it from here on
    # Smallest restitution and largest friction for which the evidence is that the law holds; see
    # `cautions`.
    known_from: float = 0.0
    known_to_friction: float = np.inf
    # Whether viscous elements take the energy, in both directions alike. Else a lumped one is the
    # paper's element, of which only the normal direction loses energy.
    dashpots: bool = False
    # Normal over tangential stiffness of a lumped element, from zeta^2 and e, floats or arrays.
    stiffness_ratio: Callable[[Any, Any], Any] = lambda zeta2, e: zeta2
    material: str = ""  # of spheres: what e follows from at each speed, by its name in a `Pair`


LOSSES = (
    Loss(
        "lumped",
        "hysteretic",
        "the paper's model: as lumped, the normal spring alone loses energy; to rounding",
        "Stronge 1994",
        known_from=1.0,  # below, measurements are divided, and finite elements differ
    ),
    # The elastic stiffness of the hysteretic element is the one of unloading, kappa/e^2. In the
    # ratio it makes the tangential one kappa/(e^2 zeta^2). Rounded as in
    # `sliding.restick_coefficient`.
    Loss(
        "lumped",
        "unloading-stiffness",
        "as lumped, with e^2 zeta^2 for zeta^2: both stiffnesses elastic; solved to rounding",
        "Stronge 1994, with the elastic stiffness of unloading in the ratio",
        least_restitution=1e-3,  # below it the tangential element is as good as rigid
        known_from=1.0,
        stiffness_ratio=lambda zeta2, e: e * (e * zeta2),
    ),
    Loss(
        "lumped",
        "viscous",
        "two Kelvin-Voigt elements of one relaxation time; solved to 1e-9",
        "T. Schwager, T. Poeschel, Granular Matter 9 (2007) 465-469, for the normal element",
        least_restitution=1e-3,  # a viscous element stops no body for good
        dashpots=True,
    ),
    # Below 0.1 most contacts of the continuum need more steps than are allowed.
    Loss(
        "continuum",
        "viscous",
        "Kelvin-Voigt spheres with micro-slip, to a tolerance; one relaxation time",
        "V. L. Popov, E. Willert, M. Hess, Facta Univ. Mech. Eng. 16 (2018) 141-156; G. Kuwabara, "
        "K. Kono, Jpn. J. Appl. Phys. 26 (1987) 1230-1233",
        least_restitution=0.1,
        dashpots=True,
        material="relaxation_time",
    ),
    Loss(
        "continuum",
        "plastic",
        "elastic-plastic spheres with micro-slip, to a tolerance; contained yielding",
        "C. Thornton, J. Appl. Mech. 64 (1997) 383-386",
        least_restitution=0.1,
        known_from=0.4,  # as known_to_friction: by data/finite_elements, see `continuum.rebound`
        known_to_friction=0.2,
        material="yield_pressure",
    ),
)
# By name; see `noncollinear.rebound` on dashpots.
LUMPED = {loss.name: loss for loss in LOSSES if loss.model == "lumped"}
NONCOLLINEAR = {name: loss for name, loss in LUMPED.items() if not loss.dashpots}
SPHERES = {loss.name: loss for loss in LOSSES if loss.model == "continuum"}
VISCOUS, PLASTIC = SPHERES["viscous"], SPHERES["plastic"]
# Names of losses by the codes that stand for them in arrays; those of spheres come first, and the
# last one is that of -1.
BY_NAME = SPHERES | {name: loss for name, loss in LUMPED.items() if name not in SPHERES}
NAMES = np.array([*BY_NAME, "none"])
CODES = {loss: code for code, loss in enumerate(SPHERES.values())}
CODE_OF: dict[str, NDArray[np.integer[Any]]] = {
    name: np.array(code, np.int8) for code, name in enumerate(BY_NAME)
}
NONE: NDArray[np.integer[Any]] = np.array(-1, np.int8)
