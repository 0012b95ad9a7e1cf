"""The compiled response of one pair of bodies in C and JavaScript.

Both evaluate as `planarimpact.response` does: the same operations in the same order.
"""

import numpy as np
from numpy.typing import NDArray

from planarimpact import __version__
from planarimpact.export import languages
from planarimpact.ground import checks, sliding
from planarimpact.ground.results import Regime
from planarimpact.response import Response

# There are at least this many cells for each piece, so that few cells have a second piece. The
# search for a piece begins at the left end of a cell.
CELLS = 8
MEANINGS = {
    "mass_ratio": "m2/m1, effective normal over tangential mass",
    "stiffness_ratio": "zeta^2, normal over tangential stiffness",
    "restitution": "e, the energetic coefficient",
}


def text(response: Response, file: str, name: str, language: str) -> str:
    """The file of a pair, whose functions and constants begin with a name where C wants it."""
    pieces = response.pieces
    beta, e = (response.parameters[key] for key in ("mass_ratio", "restitution"))
    cells = 1 << (CELLS * len(pieces.start)).bit_length()
    public = {key.upper(): response.parameters[key] for key in MEANINGS}
    public["INCIDENCE_MAX"] = min(response.incidence_max, checks.LARGEST)  # Python refuses others
    public |= {f"ERROR_{key.upper()}": v for key, v in response.error_bound._asdict().items()}
    blocks: dict[str, languages.Block] = {
        "model": _model(response),
        "public": public | {regime.name: regime.value for regime in Regime},
        "private": {
            "SCALE": cells / pieces.end,
            "SLIDES_FROM": response.slides_from,
            "CHANGE": sliding.change(beta, e),
            "IMPULSE": 1 + e,
            "GAINS": int(response.gains),
        },
        "start": np.append(pieces.start, np.inf),
        "first": _first(pieces.start, np.linspace(0.0, pieces.end, cells + 1)),
        "rows": np.concatenate([[pieces.kink, pieces.centre], *pieces.coefficients]).T,
        "label": pieces.label,
    }
    return languages.filled("pair", blocks, file, name, language)


def _first(start: NDArray[np.float64], left: NDArray[np.float64]) -> NDArray[np.int64]:
    """Pieces at the left ends of cells, where the search begins."""
    # Slightly to the left, so that rounding may begin one piece too early but never too late.
    return np.maximum(np.searchsorted(start, left * (1 - 1e-14), side="right") - 1, 0)


def _model(response: Response) -> list[str]:
    """Paragraphs about the model, for the head of the file."""
    paragraphs = [
        f"Written by planarimpact {__version__}. Do not edit it: write it anew.",
        "",
        f"Model: {response.model}, fitted with the tolerance {response.tolerance!r}, with",
    ]
    for name, value in response.parameters.items():
        paragraphs.append(f"  {name} = {value!r}: {MEANINGS.get(name, 'a setting of the model')}")
    slides = response.slides_from
    if slides <= response.incidence_max:
        paragraphs.append(f"From |x| = {slides!r} on the contact slides throughout: a formula.")
    if np.isnan(response.pieces.coefficients[1]).any():
        paragraphs.append("This model leaves peak_friction open: NaN.")
    return paragraphs
