"""Write the tables of data/lumped_40_digits from the independent 40-digit reference.

python tests/reference/exact_tables.py data/lumped_40_digits
"""

import csv
import math
import sys
from pathlib import Path

import high_precision
from mpmath import mp

BETA, ZETA2 = 3.5, 1.21
# The kinds of event as the package names them.
KINDS = {"compression ends": "maximum compression"}


def tables():
    """All tables: `{name: (header, rows)}`, numbers as text of 20 digits."""
    with mp.workdps(50):
        rebound, peak = _fig6()
        return {
            "fig3_events": _events(1.0),
            "fig4_events": _events(2.5),
            "fig6_rebound": rebound,
            "fig6_peak_friction": peak,
            "fig9_dissipation": _fig9(),
        }


def _text(number):
    return mp.nstr(mp.mpf(number), 20, strip_zeros=True)


def _events(incidence):
    header = ["curve", "event", "time [t_c]", "velocity [mu v2(0)]"]
    rows = []
    for e in (1.0, 0.5):
        for event in high_precision.rebound(incidence, BETA, ZETA2, e).events:
            kind = KINDS.get(event.kind, event.kind)
            rows.append([f"e = {e:g}", kind, _text(event.time), _text(event.velocity)])
    return header, rows


def _fig6():
    """Incidences on a grid and at every threshold with its two neighbours."""
    rebound, peak = [], []
    for e in (0.0, 0.5, 1.0):
        limit = BETA + (max(0.0, e * BETA - ZETA2 / e) if e else 0.0)
        grid = {0.25 * k for k in range(33)}
        for threshold in (ZETA2, BETA, limit):
            grid |= {threshold, math.nextafter(threshold, 0), math.nextafter(threshold, 9)}
        for x in sorted(grid):
            answer = high_precision.rebound(x, BETA, ZETA2, e)
            rebound.append([f"e = {e:g}", repr(x), _text(answer.velocity)])
            peak.append([f"e = {e:g}", repr(x), _text(answer.peak_friction)])
    header = ["curve", "incidence [mu v2(0)]"]
    force = "peak_friction_force [mu m2 Omega v2(0)]"
    return ([*header, "velocity [mu v2(0)]"], rebound), ([*header, force], peak)


def _fig9():
    header = ["curve", "angle [deg]", "friction_dissipation [m2 S^2/2]"]
    rows = []
    for mu in (0.1, 0.5):
        for e in (1.0, 0.5):
            for degrees in range(5, 90, 5):
                theta = mp.radians(degrees)
                answer = high_precision.rebound(mp.tan(theta) / mp.mpf(mu), BETA, ZETA2, e)
                share = 2 * (mu * mp.cos(theta)) ** 2 * answer.dissipation
                rows.append([f"mu = {mu:g}, e = {e:g}", f"{degrees}.0", _text(share)])
    return header, rows


def main(folder):
    for name, (header, rows) in tables().items():
        with open(Path(folder) / f"{name}.csv", "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(header)
            writer.writerows(rows)


if __name__ == "__main__":
    main(sys.argv[1])
