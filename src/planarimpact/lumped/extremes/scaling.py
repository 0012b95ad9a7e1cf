"""Groups of any size: impacts are solved in units in which no product overflows or underflows.

Three changes, none of which alters a digit of an ordinary answer:

- Velocities scale with x, beta and zeta^2 together. Where one of these is close to the largest
  number, all are multiplied by a power of 2 below 1.
- Far below zeta^2 and sqrt(beta zeta^2) forces and velocities are in proportion to the incidence.
  A tiny incidence is multiplied by a power of 2, so that no force loses digits to underflow.
- A stiffness ratio that is tiny compared with beta counts as a somewhat larger one: squares of
  angles do not underflow. In stick the velocity is at most sqrt(beta zeta^2), which is 0 to 1e-140
  of beta.
"""

import numpy as np

from planarimpact.common.arrays import Array
from planarimpact.lumped import stick_slip
from planarimpact.lumped.stick_slip import Impacts, Outcome

# Above LARGE the groups are multiplied by SHRINK.
LARGE, SHRINK = 1e300, 2.0**-40
# Below SMALL an incidence is multiplied by LIFT, if it then still is below LINEAR of zeta^2 and of
# sqrt(beta zeta^2).
SMALL, LINEAR, LIFT = 1e-100, 1e-20, 2.0**200
# The smallest stiffness ratio over beta.
LEAST_STIFFNESS = 1e-280


def solve(impacts: Impacts) -> Outcome:
    """Outcome of impacts x >= 0 of any size."""
    x, beta, zeta2, _ = impacts
    ordinary = x.min() >= SMALL and max(x.max(), beta.max(), zeta2.max()) <= LARGE
    if ordinary and zeta2.min() >= LEAST_STIFFNESS * beta.max():
        return stick_slip.solve(impacts)
    impacts, scale = shrunk(impacts)
    x, beta, zeta2, _ = impacts
    bound = LINEAR * np.minimum(zeta2, np.sqrt(beta) * np.sqrt(zeta2))
    linear = (x < SMALL) & (LIFT * np.minimum(x, SMALL) < bound)
    lift = np.where(linear, LIFT, 1.0)
    velocity, peak, work, regime = stick_slip.solve(impacts._replace(x=lift * x))
    return Outcome(velocity / (scale * lift), peak / lift, work / lift / (scale * lift), regime)


def shrunk(impacts: Impacts) -> tuple[Impacts, Array]:
    """Impacts of which no group is too large, nor zeta^2 too small; the factor of velocities."""
    x, beta, zeta2, e = impacts
    scale = np.where(np.maximum(np.maximum(x, beta), zeta2) > LARGE, SHRINK, 1.0)
    beta = scale * beta
    return Impacts(scale * x, beta, np.maximum(scale * zeta2, LEAST_STIFFNESS * beta), e), scale
