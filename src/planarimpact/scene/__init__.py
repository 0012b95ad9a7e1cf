"""Scenes: a table of impacts is solved, each impact by a formula, a table or the continuum.

A table is a pandas DataFrame with one impact in each row. `columns` lists the columns that it may
have, with the unit of each in its header. A body is a solid sphere (radius and density), or
anything with a mass, a radius of gyration and a centre of mass on the contact normal. The other
body is the same; if it has no mass, it is a wall of infinite mass, flat unless it has a radius, and
at rest unless it has a velocity or a spin. States have two dimensions. They
may have three for bodies whose radius of gyration is the same about every axis: such bodies move in
their plane of incidence.

`states` makes impacts of columns and back, `solver` solves them, `files` goes from file to file.
"""

from typing import TYPE_CHECKING

from planarimpact.collision import TOLERANCE
from planarimpact.scene.solver import Solver

if TYPE_CHECKING:  # only who solves tables needs pandas
    import pandas as pd

__all__ = ["Solver", "solve"]


def solve(
    table: "pd.DataFrame", tolerance: float = TOLERANCE, loss: str | None = None
) -> "pd.DataFrame":
    """Solve every impact of a table, by a formula, the table of spheres or the continuum.

    Parameters
    ----------
    table : DataFrame
        One impact a row; `python -m planarimpact scene --help` lists the columns. Other columns,
        whose names are not similar to these, are carried over. A table without rows has an empty
        result.
    tolerance : float
        Largest error of the velocity of the contact point at separation, in mu v2(0), and of the
        peak friction, in mu times the peak normal force; 1e-10 to 1. The default is that of
        `collide`: the whole table of spheres meets it. The error is measured
        against the continuum: the elastic one where restitution = 1, else the viscous or the
        plastic one. Elastic pairs reach some 1e-8, others 1e-5. How far a continuum is from nature
        is not part of it; `model_form` is a first measure of that.
    loss : str, optional
        What takes the normal energy where restitution is below 1: "viscous" (polymers, rubber) or
        "plastic" (metals that yield). A table may have a column of this name instead, with empty
        cells where restitution is 1, or the column relaxation_time, which is viscous, or
        yield_pressure, which is plastic.

    Returns
    -------
    DataFrame
        `table` with its index and columns, and then: the state after, named as before with
        `_after`; restitution and loss, where the table does not have them; the velocity of the
        contact point after the impact, in the direction of incidence [m/s]; `model`; `error_bound`,
        the largest error of that velocity against the continuum [m/s]; `model_form`, how far it
        would move with the other loss, to about 0.01 mu v2(0) [m/s], NaN where that is not known;
        `regime`; `incidence` v1(0)/(mu v2(0)), 0 where v1(0) = 0, else inf without friction;
        largest normal force, by the normal law of the loss, and friction [N]; `energy_lost [J]`.

    Raises
    ------
    InputError
        For what is no DataFrame, columns that are missing, misspelt or do not go together, or a bad
        row, by its number from 1, such as one below restitution 1 without a loss.
    ConvergenceError
        If the continuum does not reach the tolerance, by the row. It takes milliseconds an impact,
        at mass ratios of hundreds up to seconds; above some 10 000 most impacts end like this.

    Examples
    --------
    >>> import pandas as pd
    >>> table = pd.DataFrame(
    ...     {
    ...         "radius [m]": [0.01, 0.01],
    ...         "density [kg/m^3]": 7800.0,
    ...         "young_modulus [Pa]": 207e9,
    ...         "poisson_ratio": 0.3,
    ...         "friction": 0.2,
    ...         "restitution": 0.8,
    ...         "velocity_tangential [m/s]": [0.5, 3.0],
    ...         "velocity_normal [m/s]": 1.0,
    ...         "spin [rad/s]": 0.0,
    ...     }
    ... )
    >>> after = solve(table, loss="plastic")
    >>> after[["velocity_tangential_after [m/s]", "regime"]].values.tolist()[1]
    [2.64, 'SLIP_THROUGHOUT']
    """
    return Solver(tolerance, loss).solve(table)
