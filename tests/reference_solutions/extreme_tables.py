"""Write the table of data/lumped_extremes: impacts all over the parameter box, with conditions.

python -m tests.reference_solutions.extreme_tables data/lumped_extremes

The impacts are those of the file, whose source.yaml says how they were chosen. Ten minutes.
"""

import math
import sys

from mpmath import mp

from tests.reference_solutions import high_precision, table_files

ULP = mp.mpf(2) ** -52
SPECK = mp.mpf(10) ** -30  # less than this share of its condition is zero, seen with rounding
RESTITUTION = 3  # its place among the parameters
OUTPUTS = ("velocity", "peak_friction", "dissipation")
UNITS = ("mu v2(0)", "mu m2 Omega v2(0)", "mu^2 m2 v2(0)^2")
HEADER = [
    "incidence [mu v2(0)]",
    "mass_ratio [1]",
    "stiffness_ratio [1]",
    "restitution [1]",
    *(f"{name} [{unit}]" for name, unit in zip(OUTPUTS, UNITS, strict=True)),
    *(f"condition_{name} [{unit}]" for name, unit in zip(OUTPUTS, UNITS, strict=True)),
    "phases [1]",
]


def row(point):
    """One impact: groups as float64, outputs to 20 digits, their conditions to 3, phases.

    The condition of an output is the sum over the parameters p of |p d(output)/dp|, by
    differences over one unit in the last place, to the side where it is larger.
    """
    digits = 40 + max(int(abs(math.log10(p))) for p in point if p)
    with mp.workdps(digits + high_precision.GUARD_DIGITS):
        exact, phases = _solve(point, digits)
        again, _ = _solve(point, digits + 30)
        conditions = _conditions(point, exact, digits)
        for index, condition in enumerate(conditions):
            gap = abs(exact[index] - again[index])
            if gap > max(mp.mpf(10) ** -21 * abs(again[index]), SPECK * condition):
                raise ArithmeticError(f"{point}: two precisions differ, {exact} and {again}")
            if abs(exact[index]) <= SPECK * condition:
                exact[index] = mp.zero
        texts = [mp.nstr(value, 20) for value in exact]
        texts += [mp.nstr(value, 3) for value in conditions]
    return [*map(repr, point), *texts, str(phases)]


def _conditions(point, exact, digits):
    total = [mp.zero] * len(exact)
    for index, value in enumerate(map(mp.mpf, point)):
        largest = [mp.zero] * len(exact)
        for moved in (value * (1 + ULP), value * (1 - ULP)):
            if index == RESTITUTION and moved > 1:
                continue
            there, _ = _solve((*point[:index], moved, *point[index + 1 :]), digits)
            changes = [abs(a - b) / ULP for a, b in zip(there, exact, strict=True)]
            largest = list(map(max, largest, changes))
        total = [a + b for a, b in zip(total, largest, strict=True)]
    return total


def _solve(point, digits):
    answer = high_precision.rebound(*point, digits=digits)
    phases = sum(event.kind in ("stick", "slip") for event in answer.events)
    return [getattr(answer, name) for name in OUTPUTS], phases


def tables():
    """`{name: Table}`."""
    return table_files.impacts("lumped_extremes", HEADER, row)


if __name__ == "__main__":
    table_files.write(sys.argv[1], tables())
