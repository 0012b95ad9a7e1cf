"""Time of an impact in other codes and in our models, over the time of the table of spheres."""

from collections.abc import Sequence

from stronge1994.csv_tables import Row

# So many impacts are solved together; data/other_codes has the times of no other number.
BATCH = 100
MODELS = ("lumped", "lumped.hysteretic", "continuum", "spheres")
CODES = ("LAMMPS mindlin/force, 64 steps", "pooltool")
ERROR, LOSS, RESTITUTION = "max_velocity [mu v2(0)]", "loss", "restitution [1]"


def ratios(trade: Sequence[Row], others: Sequence[Row]) -> list[Row]:
    """Rows of each restitution and loss, the slowest first.

    `trade` has the models of ours, `others` the series data/other_codes. Times of two machines do
    not compare; those over the time of the table do. A model without a time is left out.

    >>> own = {"restitution [1]": "1.0", "loss": "", "max_velocity [mu v2(0)]": "0.2"}
    >>> table = own | {"name": "spheres, e = 1", "model": "spheres", "time_100 [s]": "2e-6"}
    >>> slow = own | {"name": "continuum, e = 1", "model": "continuum", "time_100 [s]": "6e-4"}
    >>> [(row["model"], row["times_spheres [1]"]) for row in ratios([table, slow], [])]
    [('continuum', '3e+02'), ('spheres', '1')]
    """
    column = f"time_{BATCH} [s]"
    cases: dict[tuple[float, str], list[Row]] = {}
    for row in trade:
        loss = f".{row[LOSS]}" if row[LOSS] else ""
        if row.get(column) and row["model"].removesuffix(loss) in MODELS:
            cases.setdefault((float(row[RESTITUTION]), row[LOSS]), []).append(row)
    found = []
    for (e, loss), rows in cases.items():
        base = next((float(r[column]) for r in rows if r["model"].startswith("spheres")), None)
        if base is None:
            continue
        same = [
            (row["name"].rsplit(", e = ", 1)[0], float(row[column]) / base, row) for row in rows
        ]
        same += [
            (row["curve"], float(row["times_table [1]"]), row)
            for row in others
            if (float(row[RESTITUTION]), row[LOSS]) == (e, loss) and row["curve"] in CODES
        ]
        found += [
            {
                "model": name,
                RESTITUTION: f"{e:g}",
                LOSS: loss,
                ERROR: f"{float(row[ERROR]):.2g}",
                "times_spheres [1]": f"{times:.2g}",
            }
            for name, times, row in sorted(same, key=lambda one: -one[1])
        ]
    return found
