"""Write the table of data/lumped_extremes: impacts all over the parameter box, with conditions.

python -m tests.reference_solutions.extreme_tables data/lumped_extremes

Ten minutes of one core.
"""

import math
import random
import sys
from functools import partial

from mpmath import mp

from tests.reference_solutions import high_precision, table_files

MOST_PHASES = 3000  # an impact of more would take minutes
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

# Each parameter: its special values, and spans of its logarithm from which one is drawn.
MASS_RATIOS = [1.0, (0, 1), (1, 6), 1e6]
STIFFNESS_RATIOS = [(k, k + 1) for k in range(-8, 12)] + [1e-8, 1e12]
RESTITUTIONS = [0.0, 5e-324, 1e-300, (-300, -16), (-16, -8), (-8, -4), (-4, -2), (-2, -1)]
RESTITUTIONS += [(-1, 0), (-0.3, 0), 0.5, math.nextafter(1, 0), 1.0]
INCIDENCES = [0.0, 5e-324, 1e-310, 1e-300, 1e300, (-300, -16), (-16, -8), (-8, -4), (-4, -2)]
INCIDENCES += [(-2, 0), (0, 2), (2, 4), (4, 8), (8, 16), (16, 300)]
# Factors of the largest threshold.
FACTORS = [(-12, -6), (-6, -3), (-3, -2), (-2, -1), (-1, 0), (-1, 0), (-0.1, 0.1), (0, 3)]
PHASES = (3, 10, 30, 100, 300, 1000, 2000, 2900)
HARD = [
    (5.838395000619867, 1.0, 10.0, 1.7e-7),  # crossing of N near its crest, vanishing slope
    (0.1, 3.6771579821005655, 0.1, 1.0),  # |T| past its crest while its ratio to N rises
    (0.159, 6.082350551988165, 6.082350551988165, 1.0),  # T proportional to N to the end
    (1.0, 4.0, 1.0, 1.0),  # resonance: sticks throughout
]

# Switches, where the order of phases or the direction of the last slip changes, are sought from
# impacts of these e and e omega/Omega, by moving one parameter by such a factor; neighbours of a
# switch stand so far from it, relatively.
SWITCHES = 80
SWITCH_RESTITUTIONS = [1.0, math.nextafter(1, 0), (-4, -1), (-1, 0), (-1, 0)]
SWITCH_RATES = [(-1, 0), (-0.1, 0.1), (0, 0.6), (0, 0.6), (0.6, 1)]
MOVES = [0.5, 0.8, 1.25, 2.0]
DISTANCES = [1e-12, 1e-9, 1e-7, 1e-6, 3e-6, 1e-5, 3e-5, 1e-4]


def points():
    """Impacts of the table, `(incidence, mass ratio, stiffness ratio, restitution)`, each once."""
    dice = random.Random(1994)
    found = [*HARD]
    for e_span in RESTITUTIONS:
        for zeta2_span in STIFFNESS_RATIOS:
            for beta_span in MASS_RATIOS:
                beta, zeta2, e = (_draw(s, dice) for s in (beta_span, zeta2_span, e_span))
                found += _incidences(beta, zeta2, e, dice, 1, 1)
        for beta_span in MASS_RATIOS:  # resonance and the onset of sticking again
            beta, e = _draw(beta_span, dice), _draw(e_span, dice)
            for zeta2 in (beta, e * e * beta, e * e * beta / 4):
                zeta2 = _neighbour(zeta2, dice)
                if _in_box((0.0, beta, zeta2, e)):
                    found += _incidences(beta, zeta2, e, dice, 2, 1)
    for phases in PHASES:
        for e_span in ((-4, -1), (-1, 0), 1.0):
            for beta_span in (1.0, (0, 1), (1, 6)):
                beta, e = _draw(beta_span, dice), _draw(e_span, dice)
                zeta2 = rounded(e * e * beta / phases**2)
                if zeta2 >= 1e-8:
                    limit = thresholds(beta, zeta2, e)[2]
                    found += _incidences(beta, zeta2, e, dice, 1, 0)
                    found.append((rounded(limit * dice.random()), beta, zeta2, e))
    found += _around_switches(dice)
    return [p for p in dict.fromkeys(found) if _phases(*p) <= MOST_PHASES]


def thresholds(beta, zeta2, e):
    """Incidences at which the order of phases changes, or a source says so, as float64."""
    with mp.workdps(700):  # e may be denormal
        beta, zeta2, e = map(mp.mpf, (beta, zeta2, e))
        late = max(mp.zero, e * beta - zeta2 / e) if e else mp.zero
        found = [zeta2, beta, max(zeta2, beta + late), (1 + e) * beta]
        if zeta2 > beta:  # stick may break before maximum compression from here on
            omega = mp.sqrt(beta / zeta2)
            found.append(zeta2 * omega / mp.sin(omega * mp.pi / 2))
        return [float(x) for x in found]


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


def _incidences(beta, zeta2, e, dice, at_thresholds, elsewhere):
    """Impacts with these ratios: some at or beside a threshold, as many others."""
    places = thresholds(beta, zeta2, e)
    chosen = [_neighbour(one_of(places, dice), dice) for _ in range(at_thresholds)]
    for _ in range(elsewhere):
        span = one_of([*INCIDENCES, *FACTORS], dice)
        x = _draw(span, dice)
        chosen.append(rounded(x * max(places)) if span in FACTORS else x)
    return [(x, beta, zeta2, e) for x in chosen]


def _around_switches(dice):
    """Impacts on both sides of a switch, its two neighbours among them, in one parameter."""
    found = []
    for _ in range(SWITCHES):
        low, high, which = _switch(dice)
        found += [low, high]
        for distance in DISTANCES:
            for end, side in ((low, -1), (high, 1)):
                away = side * distance * (1 + dice.random())
                found.append(_with(end, which, end[which] * (1 + away)))
    return list(filter(_in_box, found))


def _switch(dice):
    """Two impacts of different courses that differ in one parameter by one unit in the last place.

    Returns
    -------
    below, above : tuple
        With the smaller and the larger value of that parameter.
    which : int
        Its place.
    """
    while True:
        beta = _draw(one_of([1.0, (0, 1), (0, 1), (1, 6)], dice), dice)
        e = _draw(one_of(SWITCH_RESTITUTIONS, dice), dice)
        zeta2 = rounded(beta * (e / _draw(one_of(SWITCH_RATES, dice), dice)) ** 2)
        x = rounded(one_of([zeta2, max(thresholds(beta, zeta2, e))], dice) * dice.random())
        which = one_of([0, 0, 0, 1, 2, RESTITUTION], dice)
        start = x, beta, zeta2, e
        moved = _with(start, which, rounded(start[which] * one_of(MOVES, dice)))
        below, above = sorted((start, moved))
        if not (_in_box(below) and _in_box(above)):
            continue
        if course(below) == course(above):
            continue
        low, high = bisected(below[which], above[which], partial(_course_of, start, which))
        return _with(start, which, low), _with(start, which, high), which


def bisected(low, high, function):
    """The two neighbouring numbers between which a function changes from its value at `low`."""
    first = function(low)
    while math.nextafter(low, high) < high:
        middle = low + (high - low) / 2
        low, high = (middle, high) if function(middle) == first else (low, middle)
    return low, high


def _course_of(point, which, value):
    return course(_with(point, which, value))


def course(point):
    """Order of phases, and direction of the last slip."""
    events = [e for e in high_precision.rebound(*point).events if e.kind in ("stick", "slip")]
    directions = [mp.sign(e.friction or e.velocity) for e in events if e.kind == "slip"]
    return [e.kind for e in events], directions[-1:]


def _in_box(point):
    _, beta, zeta2, e = point
    return 1 <= beta <= 1e6 and 1e-8 <= zeta2 <= 1e12 and e <= 1


def _with(point, which, value):
    return (*point[:which], value, *point[which + 1 :])


def _draw(span, dice):
    """A special value as it is, or one drawn from a span of logarithms."""
    if isinstance(span, float):
        return span
    return rounded(10 ** (span[0] + (span[1] - span[0]) * dice.random()))


def rounded(value):
    """Six digits: the same on every machine, and short in the table."""
    return float(f"{value:.6g}")


def one_of(values, dice):
    return values[int(len(values) * dice.random())]


def _neighbour(value, dice):
    """The number itself or the next one on either side."""
    return one_of([value, math.nextafter(value, 0), math.nextafter(value, math.inf)], dice)


def _phases(x, beta, zeta2, e):
    """About how many phases an impact has: T goes round while N is below its amplitude."""
    sliding = x >= thresholds(beta, zeta2, e)[2]
    amplitude = min(1.0, x / math.sqrt(beta * zeta2)) if x <= zeta2 else 1.0
    return 0 if sliding else e * math.sqrt(beta / zeta2) * math.asin(amplitude) * 2 / math.pi


def tables():
    """`{name: Table}`."""
    return {"impacts": table_files.table(HEADER, row, [(point,) for point in points()])}


if __name__ == "__main__":
    table_files.write(sys.argv[1], tables())
