"""How far the cheaper models are from the reference: largest errors, as measured.

At e = 1 the reference is the elastic continuum. With velocities in units of zeta^2 every model here
depends on x/zeta^2 and chi = beta/(2 zeta^2) alone. So one table over chi serves all pairs of
bodies. For e < 1 no cheaper model is near its continuum, see `choice`.
"""

import numpy as np

from planarimpact.ground.arrays import Array, ArrayLike

CHI = 0.5 * 2.0 ** (np.arange(41) / 8)
# Over all incidences that stick at some time, to three decimals, rounded up. Made by
# tests/package_tables/gap_tables.py, and checked between the entries by tests/reference.
# fmt: off
VELOCITY = {
    "lumped": (
        0.000, 0.001, 0.002, 0.004, 0.008, 0.014, 0.021, 0.032, 0.045, 0.064, 0.088, 0.121,
        0.164, 0.225, 0.313, 0.445, 0.605, 0.662, 0.674, 0.667, 0.656, 0.642, 0.635, 0.623,
        0.611, 0.598, 0.582, 0.565, 0.548, 0.526, 0.570, 0.628, 0.797, 1.019, 1.132, 1.221,
        1.312, 1.392, 1.459, 1.522, 1.566,
    ),
    "rigid": (
        1.000, 1.044, 1.086, 1.128, 1.170, 1.211, 1.251, 1.291, 1.329, 1.367, 1.404, 1.439,
        1.474, 1.508, 1.540, 1.572, 1.602, 1.631, 1.659, 1.686, 1.711, 1.735, 1.758, 1.780,
        1.801, 1.820, 1.839, 1.856, 1.873, 1.888, 1.903, 1.916, 1.929, 1.941, 1.952, 1.962,
        1.972, 1.980, 1.989, 1.996, 2.004,
    ),
}
PEAK_FRICTION = {
    "lumped": (
        0.001, 0.006, 0.012, 0.017, 0.022, 0.027, 0.031, 0.035, 0.038, 0.041, 0.044, 0.047,
        0.049, 0.052, 0.054, 0.055, 0.057, 0.058, 0.060, 0.061, 0.062, 0.063, 0.063, 0.064,
        0.064, 0.065, 0.065, 0.066, 0.066, 0.066, 0.066, 0.066, 0.066, 0.066, 0.066, 0.066,
        0.067, 0.067, 0.067, 0.067, 0.067,
    ),
    "rigid": (
        0.415, 0.404, 0.393, 0.383, 0.372, 0.362, 0.352, 0.342, 0.333, 0.323, 0.314, 0.305,
        0.296, 0.287, 0.279, 0.270, 0.262, 0.254, 0.246, 0.239, 0.231, 0.224, 0.217, 0.208,
        0.196, 0.187, 0.180, 0.174, 0.168, 0.162, 0.156, 0.151, 0.146, 0.141, 0.136, 0.131,
        0.126, 0.121, 0.116, 0.111, 0.107,
    ),
}
# fmt: on
# Factor for errors between the entries of the table, or between the incidences that were solved.
MARGIN = 1.1


def elastic(model: str, mass_ratio: ArrayLike, stiffness_ratio: ArrayLike) -> Array:
    """Largest error of a model against the continuum, e = 1.

    Parameters
    ----------
    model : str
        "rigid" or "lumped".
    mass_ratio, stiffness_ratio : array_like

    Returns
    -------
    ndarray of float64 or float
        Of velocity (mu v2(0)) or peak friction (mu F2max), whichever is larger; infinite outside
        the table.

    Examples
    --------
    >>> round(float(elastic("lumped", 3.5, 17 / 14)), 2)
    0.24
    """
    beta, zeta2 = np.broadcast_arrays(mass_ratio, stiffness_ratio)
    chi = beta / zeta2 / 2
    velocity = np.interp(np.log(chi), np.log(CHI), VELOCITY[model])
    peak = np.interp(np.log(chi), np.log(CHI), PEAK_FRICTION[model])
    gap = MARGIN * np.maximum(zeta2 * velocity, peak)
    return np.where((chi >= CHI[0]) & (chi <= CHI[-1]), gap, np.inf)[()]
