"""What is known of where a law holds, as data that stand beside its answer.

No tolerance and no error of a solver shows this. The numbers are those of `losses` and of
`bodies.COUPLING`; they come from finite elements (data/finite_elements) and from measurements.
"""

from __future__ import annotations

from enum import IntFlag

import numpy as np

from planarimpact.common.arrays import Array, ArrayLike, Integers
from planarimpact.common.losses import BY_NAME, CODE_OF, NONE
from planarimpact.common.records import Members

# By the code of a loss, the last one where nothing is lost.
_FROM = np.array([*(loss.known_from for loss in BY_NAME.values()), 0.0])
_TO_FRICTION = np.array([*(loss.known_to_friction for loss in BY_NAME.values()), np.inf])


class Caution(IntFlag, metaclass=Members):
    """Why an answer may not hold: none of these, or a sum of them.

    Examples
    --------
    >>> print(Caution.of("plastic", friction=0.4, restitution=0.8).text)
    friction is above what the loss is known to hold for (plastic 0.2): there it exceeds the shear \
strength of the surface, and solid spheres are off by up to 0.9 mu v2(0)
    """

    NONE = 0
    RESTITUTION = 1
    FRICTION = 2
    DISSIMILAR = 4
    NO_MICRO_SLIP = 8

    @property
    def text(self) -> str:
        """Why, in words; an empty text where there is nothing to say."""
        return "; ".join(_TEXTS[caution] for caution in self)

    @classmethod
    def of(
        cls, loss: str | None, friction: float, restitution: float, dissimilar: bool = False
    ) -> Caution:
        """That of one pair of materials that sticks at some time; there may be no such loss."""
        code = CODE_OF.get(loss or "", NONE) if restitution < 1 else NONE
        return cls(int(cls.codes(code, friction, restitution, dissimilar)))

    @classmethod
    def codes(
        cls, loss_code: Integers, friction: ArrayLike, restitution: ArrayLike, dissimilar: ArrayLike
    ) -> Integers:
        """Sums of codes by those of the loss, which say nothing of the model; they broadcast."""
        return (
            cls.RESTITUTION * (np.asarray(restitution) < _FROM[loss_code])
            + cls.FRICTION * (np.asarray(friction) > _TO_FRICTION[loss_code])
            + cls.DISSIMILAR * np.asarray(dissimilar)
        )


def _listed(numbers: Array, but: float) -> str:
    """Losses with their numbers, those left out for which there is no bound."""
    pairs = zip(BY_NAME, numbers, strict=False)
    return ", ".join(f"{name} {number:g}" for name, number in pairs if number != but)


_TEXTS = {
    Caution.RESTITUTION: "restitution is below what the loss is known to hold from "
    f"({_listed(_FROM, 0)}): plastic spheres are off by up to 0.2 mu v2(0) at 0.39, and the others "
    "by up to 0.9 from a continuum at 0.8",
    Caution.FRICTION: "friction is above what the loss is known to hold for "
    f"({_listed(_TO_FRICTION, np.inf)}): there it exceeds the shear strength of the surface, and "
    "solid spheres are off by up to 0.9 mu v2(0)",
    Caution.DISSIMILAR: "the bodies spread differently under pressure (bodies.dundurs), which no "
    "model has: the velocity may be off by more than 0.1 mu v2(0), with plastic loss up to 0.5",
    Caution.NO_MICRO_SLIP: "the model has no micro-slip: its error against the continuum is not "
    "known for these bodies; `python -m planarimpact models` compares them",
}
