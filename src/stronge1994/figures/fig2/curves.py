"""Fig. 2: force against deflection of the normal and the tangential element."""

from stronge1994 import tables
from stronge1994.tables import Table


def curves(stiffness_ratio: float, restitution: float) -> Table:
    """Loading and unloading lines in the units of Table 1.

    The normal element unloads with the slope 1/e^2; the tangential one has the slope 1/zeta^2.

    >>> unloading = tables.select(curves(1.21, 0.5), variant="normal unloading")
    >>> unloading["deflection [v2(0)/Omega]"].tolist()  # 1 - e^2 remains
    [1.0, 0.75]
    """
    lines = {
        "normal loading": ([0.0, 1.0], [0.0, 1.0]),
        "normal unloading": ([1.0, 1.0 - restitution**2], [1.0, 0.0]),
        "tangential": ([-1.0, 1.0], [-1.0 / stiffness_ratio, 1.0 / stiffness_ratio]),
    }
    columns = ("deflection [v2(0)/Omega]", "force [m2 Omega v2(0)]")
    return tables.join(
        tables.curve(dict(zip(columns, line, strict=True)), "lumped", variant)
        for variant, line in lines.items()
    )
