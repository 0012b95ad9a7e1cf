"""Write the tables of data/closed_forms: what a line of algebra gives, with 50 digits.

python -m tests.reference_solutions.closed_form_tables data/closed_forms
"""

import sys

from mpmath import mp

from tests.reference_solutions import exact_tables, table_files
from tests.reference_solutions.exact_tables import BETA, INCIDENCE, VELOCITY, ZETA2
from tests.reference_solutions.table_files import Table, table


@mp.workdps(table_files.DIGITS)
def tables():
    """All tables, `{name: Table}`."""
    return {
        "fig2_elements": _fig2(),
        "fig5_rebound": _fig5(),
        "fig7_peak_force": _fig7(),
        "fig9_dissipation": _fig9(),
    }


# Force against deflection --------------------------------------------------------------------


def _fig2():
    """Ends of the lines, e = 0.5.

    The normal element is compressed by v2(0)/Omega, with stiffness 1. In restitution it gives back
    e^2 of the work: the triangle under the line of unloading has e^2 of the area of the other, and
    the same height, so e^2 of its base.
    """
    base = mp.mpf("0.5") ** 2
    lines = {
        "normal loading": [(0, 0), (1, 1)],
        "normal unloading": [(1, 1), (1 - base, 0)],
        "tangential": [(s, s / mp.mpf(ZETA2)) for s in (-1, 1)],
    }
    header = ["variant", "deflection [v2(0)/Omega]", "force [m2 Omega v2(0)]"]
    ends = [(variant, *point) for variant, points in lines.items() for point in points]
    return table(header, lambda variant, *point: [variant, *map(mp.mpf, point)], ends)


# Without tangential compliance: slides until the impulse is x/beta, then sticks ----------------


def _fig5():
    grid = (0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 6.5, 6.9, 7.0, 7.1, 7.5, 8.0, 10.0, 12.0, 14.0)
    return table(["model", INCIDENCE, VELOCITY], _rebound, [(x,) for x in grid])


def _rebound(x):
    return ["rigid", x, max(mp.zero, mp.mpf(x) - 2 * mp.mpf(BETA))]


def _fig7():
    """Without tangential compliance; the largest normal force; and the border of sliding.

    At the border x = 2 beta - zeta^2 friction is mu cos(theta) at its largest, mu = tan(theta)/x.
    """
    border = 2 * mp.mpf(BETA) - mp.mpf(ZETA2)
    header = [*exact_tables.CURVE, *exact_tables.FIG7_COLUMNS]
    angles = [*exact_tables.FIG7_ANGLES, 90.0]
    lines = [("normal force", mp.cos, mp.one), ("slip throughout", mp.sin, border)]
    turned = [(variant, angle, *line) for variant, *line in lines for angle in angles]
    halted = [(mu, a) for mu in exact_tables.FRICTIONS for a in exact_tables.fig7_angles(mu)]
    rows = table(header, _turned, turned).rows + table(header, _halted_force, halted).rows
    return Table(header, rows)


def _turned(variant, angle, function, over):
    return ["lumped", variant, None, angle, function(mp.radians(angle)) / over]


def _halted_force(mu, angle):
    theta = mp.radians(angle)
    halt = mp.tan(theta) / mp.mpf(mu) / mp.mpf(BETA)  # impulse
    # The impulse is 1 - cos(tau), the force sin(tau) up to the greatest compression.
    normal = mp.sqrt(halt * (2 - halt)) if halt < 1 else mp.one
    return ["rigid", None, mu, angle, mp.mpf(mu) * mp.cos(theta) * normal]


def _fig9():
    places = []
    for mu, e in exact_tables.UNSOLVED_FIG9:
        angles = {float(k) for k in range(5, 90, 5)}
        angles |= set(exact_tables.threshold_angles(mu, (1 + e) * BETA))
        places += [(mu, e, angle) for angle in sorted(angles)]
    return table(["model", *exact_tables.FIG9_COLUMNS], _halted_work, places)


def _halted_work(mu, e, angle):
    """Loss of tangential kinetic energy; m1 v1(0)^2/2 if slip halts."""
    theta = mp.radians(angle)
    before = mp.tan(theta) / mp.mpf(mu)
    after = max(mp.zero, before - (1 + mp.mpf(e)) * mp.mpf(BETA))
    lost = (before**2 - after**2) / mp.mpf(BETA) * (mp.mpf(mu) * mp.cos(theta)) ** 2
    return ["rigid", mu, e, angle, lost]


if __name__ == "__main__":
    table_files.write(sys.argv[1], tables())
