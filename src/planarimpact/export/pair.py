"""The compiled response of one pair of bodies in C and JavaScript.

Both evaluate as `planarimpact.response` does: the same operations in the same order.
"""

import math
from string import Template
from typing import Any

import numpy as np
from numpy.typing import NDArray

from planarimpact import __version__
from planarimpact.export.languages import LANGUAGES, Language, comment, number, table
from planarimpact.ground import checks, sliding
from planarimpact.ground.results import Regime
from planarimpact.response import Response

# The search for a piece begins at the left of one of so many cells for each piece, or more: few
# cells have a second piece.
CELLS = 8
MEANINGS = {
    "mass_ratio": "m2/m1, effective normal over tangential mass",
    "stiffness_ratio": "zeta^2, normal over tangential stiffness",
    "restitution": "e, the energetic coefficient",
}

TABLES = [
    "Polynomials over pieces of |x|, in the variable sqrt(|x| - kink) - centre.",
    "  start: left ends of the pieces, and infinity",
    "  first: the piece at the left of each cell of equal width, where the search begins",
    "  rows: kink, centre, coefficients of velocity and of peak friction in ascending powers",
    "  label: regime of the piece",
]
# 0 - most, as -most would make -0 of 0.
CODE = {
    "c": """\
struct ${p}result {
    double velocity;
    double peak_friction;
    double dissipation;
    int regime;
};

/* The piece of a size |x|. */
static inline int ${p}piece(double size)
{
    int piece = ${p}first[(int)(size * $scale)];
    while (size >= ${p}start[piece + 1])
        ++piece;
    return piece;
}

/* Its variable there. */
static inline double ${p}root(int piece, double size)
{
    const double *row = ${p}rows + $row * piece;
    return sqrt(size - row[0]) - row[1];
}

/* A polynomial with these coefficients of ascending powers. */
static inline double ${p}polynomial(const double *c, double root)
{
    double value = $horner;
    return value;
}

static inline double ${p}clipped(double value, double low, double high)
{
    return value < low ? low : value > high ? high : value;
}

/* Velocity for |x|, at most so large, where the contact does not slide throughout. */
static inline double ${p}fitted(int piece, double root, double most)
{
    return ${p}clipped(${p}polynomial(${p}rows + $row * piece + 2, root), 0.0 - most, most);
}

/* Tangential velocity of the contact point at separation, v1(tf)/(mu v2(0)); NaN out of range. */
static inline double ${p}velocity(double x)
{
    double size = fabs(x), velocity;
    if (!(size <= ${P}INCIDENCE_MAX))
        return $nan;
    if (size >= $slides_from) {
        velocity = size - $change;
    } else {
        int piece = ${p}piece(size);
        velocity = ${p}fitted(piece, ${p}root(piece, size), $most);
    }
    return velocity * copysign(1.0, x);
}

/* The state at separation; NaN, and ${P}UNRESOLVED, out of range. */
static inline struct ${p}result ${p}rebound(double x)
{
    struct ${p}result found = {$nan, $nan, $nan, ${P}UNRESOLVED};
    double size = fabs(x), impulse;
    if (!(size <= ${P}INCIDENCE_MAX))
        return found;
    if (size >= $slides_from) {
        found.velocity = size - $change;
        impulse = $impulse;
        found.peak_friction = 1.0;
        found.regime = ${P}SLIP_THROUGHOUT;
    } else {
        int piece = ${p}piece(size);
        double root = ${p}root(piece, size);
        const double *c = ${p}rows + $row * piece + $peak;
        found.velocity = ${p}fitted(piece, root, $most);
        impulse = (size - found.velocity) / ${P}MASS_RATIO;
        found.peak_friction = ${p}clipped(${p}polynomial(c, root), 0.0, 1.0);
        found.regime = ${p}label[piece];
    }
    if (!(size > 0.0))
        found.regime = ${P}STICK;
    found.dissipation = impulse * (size / 2.0 + found.velocity / 2.0);
    found.velocity *= copysign(1.0, x);
    return found;
}
""",
    "js": """\
/**
 * @typedef {object} Result
 * @property {number} velocity
 * @property {number} peak_friction
 * @property {number} dissipation
 * @property {number} regime
 */

/**
 * The piece of a size |x|.
 * @param {number} size
 * @returns {number}
 */
function piece_of(size) {
    let piece = first[Math.trunc(size * $scale)];
    while (size >= start[piece + 1]) piece += 1;
    return piece;
}

/**
 * Its variable there.
 * @param {number} piece
 * @param {number} size
 * @returns {number}
 */
function root_of(piece, size) {
    const at = $row * piece;
    return Math.sqrt(size - rows[at]) - rows[at + 1];
}

/**
 * A polynomial with the coefficients of ascending powers that begin there.
 * @param {number} at
 * @param {number} root
 * @returns {number}
 */
function polynomial(at, root) {
    let value = $horner;
    return value;
}

/**
 * @param {number} value
 * @param {number} low
 * @param {number} high
 * @returns {number}
 */
function clipped(value, low, high) {
    return value < low ? low : value > high ? high : value;
}

/**
 * Velocity for |x|, at most so large, where the contact does not slide throughout.
 * @param {number} piece
 * @param {number} root
 * @param {number} most
 * @returns {number}
 */
function fitted(piece, root, most) {
    return clipped(polynomial($row * piece + 2, root), 0 - most, most);
}

/**
 * Velocity in the direction of x.
 * @param {number} velocity
 * @param {number} x
 * @returns {number}
 */
function directed(velocity, x) {
    return x < 0 || Object.is(x, -0) ? -velocity : velocity;
}

/**
 * Tangential velocity of the contact point at separation.
 * @param {number} x incidence, v1(0)/(mu v2(0))
 * @returns {number} v1(tf)/(mu v2(0)); NaN out of range
 */
export function velocity(x) {
    const size = Math.abs(x);
    if (!(size <= ${P}INCIDENCE_MAX)) return NaN;
    if (size >= $slides_from) return directed(size - $change, x);
    const piece = piece_of(size);
    return directed(fitted(piece, root_of(piece, size), $most), x);
}

/**
 * The state at separation.
 * @param {number} x incidence, v1(0)/(mu v2(0))
 * @returns {Result} NaN, and UNRESOLVED, out of range
 */
export function rebound(x) {
    const size = Math.abs(x);
    let velocity = NaN, impulse = NaN, peak_friction = NaN, regime = UNRESOLVED;
    if (size <= ${P}INCIDENCE_MAX) {
        if (size >= $slides_from) {
            velocity = size - $change;
            impulse = $impulse;
            peak_friction = 1;
            regime = SLIP_THROUGHOUT;
        } else {
            const piece = piece_of(size), root = root_of(piece, size);
            velocity = fitted(piece, root, $most);
            impulse = (size - velocity) / MASS_RATIO;
            peak_friction = clipped(polynomial($row * piece + $peak, root), 0, 1);
            regime = label[piece];
        }
        if (size === 0) regime = STICK;
    }
    const dissipation = impulse * (size / 2 + velocity / 2);
    return { velocity: directed(velocity, x), peak_friction, dissipation, regime };
}
""",
}

WORDS = """\
$file: the rebound of one pair of rough bodies after an oblique impact.
Written by planarimpact $version. Do not edit it: write it anew.

Model: $model, with
$groups

Functions of the incidence x = v1(0)/(mu v2(0)), of any sign:
  ${p}velocity(x) is the velocity alone.
  ${p}rebound(x) has
    velocity: v1(tf)/(mu v2(0)), which has the sign opposite to x where the contact point has
      turned round
    peak_friction: largest friction, over mu times the largest normal force.$silent
    dissipation: work of friction, in mu^2 m2 v2(0)^2
    regime: the order of stick and slip, one of the codes below

Units and signs: v1 and v2 are the tangential and the normal velocity of the contact point, before \
the impact (0) and after it (tf), both in one unit. v2(0) is positive towards the surface. mu is \
the coefficient of friction, above 0.

Range: |x| up to ${P}INCIDENCE_MAX.$formula For any other x, NaN among them, the numbers are NaN \
and the regime is ${P}UNRESOLVED.

Measured error against the model: ${P}ERROR_VELOCITY for velocity and ${P}ERROR_PEAK_FRICTION for \
peak_friction. That is twice the largest difference that a search found, plus the tolerance of the \
model if it has one. Nothing is proved: a narrow kink of the model may have escaped the search. A \
regime changes within a hundredth of $tolerance, the tolerance of the fit, from where that of the \
model does.

Example:
$example
"""
EXAMPLES = {
    "c": """\
  #include "$file"

  double v1 = 6.0, v2 = 5.0, mu = 0.8; // before the impact
  double v1_after = mu * v2 * ${p}velocity(v1 / (mu * v2));
  double v2_after = -${P}RESTITUTION * v2;""",
    "js": """\
  import * as pair from "./$file";

  const v1 = 6, v2 = 5, mu = 0.8; // before the impact
  const v1_after = mu * v2 * pair.velocity(v1 / (mu * v2));
  const v2_after = -pair.RESTITUTION * v2;""",
}


def text(response: Response, file: str, name: str, language: str) -> str:
    """The file of a pair.

    Parameters
    ----------
    response : Response
    file : str
        What the file is called.
    name : str
        What its functions and constants begin with, where the language wants it.
    language : str
        A key of `LANGUAGES`.
    """
    chosen = LANGUAGES[language]
    prefix = f"{name}_" if chosen.named else ""
    pieces = response.pieces
    rows = np.concatenate([[pieces.kink, pieces.centre], *pieces.coefficients]).T
    tables = {
        "start": np.append(pieces.start, np.inf),
        "first": _first(response),
        "rows": rows,
        "label": pieces.label.astype(np.uint8),
    }
    blocks = [
        _constants(response, prefix.upper(), chosen),
        comment(TABLES),
        *(table(prefix + key, values, chosen) for key, values in tables.items()),
        _code(response, prefix, language),
    ]
    return chosen.file.format(
        words=comment(_words(response, file, prefix, language)),
        NAME=name.upper(),
        code="\n".join(blocks),
    )


def _first(response: Response) -> NDArray[Any]:
    """Piece at the left of each cell of equal width, where the search begins."""
    start, end = response.pieces.start, response.pieces.end
    left = np.linspace(0.0, end, _cells(response) + 1)
    # A hair to the left: rounding must not skip a piece, only begin one too early.
    first = np.searchsorted(start, left * (1 - 1e-14), side="right") - 1
    return np.maximum(first, 0).astype(np.min_scalar_type(len(start)))


def _reach(response: Response) -> float:
    """Largest |x|: beyond, Python refuses it."""
    return min(response.incidence_max, checks.LARGEST)


def _cells(response: Response) -> int:
    return 1 << (CELLS * len(response.pieces.start)).bit_length()


def _constants(response: Response, prefix: str, language: Language) -> str:
    """What users may read: groups, range, errors and the codes of regimes."""
    values = {name.upper(): response.parameters[name] for name in MEANINGS}
    values["INCIDENCE_MAX"] = _reach(response)
    values |= {f"ERROR_{name.upper()}": v for name, v in response.error_bound._asdict().items()}
    lines = [(name, number(value, language)) for name, value in values.items()]
    lines += [(regime.name, str(regime.value)) for regime in Regime]
    return "".join(language.constant.format(name=prefix + n, value=v) for n, v in lines)


def _code(response: Response, prefix: str, language: str) -> str:
    """The functions, which name numbers and tables."""
    beta, e = (response.parameters[name] for name in ("mass_ratio", "restitution"))
    numbers = {
        "scale": _cells(response) / response.pieces.end,
        "slides_from": response.slides_from,
        "change": sliding.change(beta, e),
        "impulse": 1 + e,
        "nan": math.nan,
    }
    powers = response.pieces.coefficients.shape[1]
    return Template(CODE[language]).substitute(
        {key: number(value, LANGUAGES[language]) for key, value in numbers.items()},
        p=prefix,
        P=prefix.upper(),
        row=2 + 2 * powers,
        peak=2 + powers,
        horner=_horner("rows[at + {}]" if language == "js" else "c[{}]", powers),
        # The clip keeps rounding and the fit from creating energy where the model does not.
        most=number(math.inf, LANGUAGES[language]) if response.gains else "size",
    )


def _horner(coefficient: str, powers: int) -> str:
    """Horner's rule: how `value` begins, and what follows.

    Examples
    --------
    >>> print("value = " + _horner("c[{}]", 3))
    value = c[2];
        value = value * root + c[1];
        value = value * root + c[0]
    """
    first, *others = (coefficient.format(power) for power in reversed(range(powers)))
    return first + "".join(f";\n    value = value * root + {other}" for other in others)


def _words(response: Response, file: str, prefix: str, language: str) -> list[str]:
    """What the file says about itself, a paragraph each."""
    groups = [
        f"  {name} = {value!r}: {MEANINGS.get(name, 'a setting of the model')}"
        for name, value in response.parameters.items()
    ]
    slides = response.slides_from
    formula = f" From |x| = {slides!r} on the contact slides throughout, which is a formula."
    silent = np.isnan(response.pieces.coefficients[1]).any()
    P = prefix.upper()
    return (
        Template(WORDS)
        .substitute(
            file=file,
            version=__version__,
            model=response.model,
            groups="\n".join(groups),
            formula=formula if slides <= response.incidence_max else "",
            silent=" This model leaves it open: NaN." if silent else "",
            tolerance=repr(response.tolerance),
            example=Template(EXAMPLES[language]).substitute(file=file, p=prefix, P=P),
            p=prefix,
            P=P,
        )
        .splitlines()
    )
