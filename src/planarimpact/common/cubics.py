"""Cubics through values and changes at both ends of a step."""

from planarimpact.common.arrays import Array, Numbers


def between(before: Array, after: Array, rise: Array, fall: Array, share: Numbers) -> Array:
    """Value at a share of a step; `rise` and `fall` are the slopes at its ends times the step.

    Examples
    --------
    >>> between(0.0, 1.0, 0.0, 3.0, 0.5)  # the cube
    0.125
    """
    return value(coefficients(before, after, rise, fall), share)


def coefficients(before: Array, after: Array, rise: Array, fall: Array) -> tuple[Array, ...]:
    """Coefficients of ascending powers of the share of a step."""
    change = after - before
    return before, rise, 3 * change - 2 * rise - fall, rise + fall - 2 * change


def value(cubic: tuple[Array, ...], share: Numbers) -> Array:
    """Value of a cubic with these coefficients."""
    constant, linear, square, third = cubic
    return constant + share * (linear + share * (square + share * third))
