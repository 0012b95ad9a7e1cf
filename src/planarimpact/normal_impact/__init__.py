"""Normal (head-on) impact of spheres by three laws of contact.

- `hertz`: elastic.
- `kelvin_voigt`: viscous, the law of Kuwabara & Kono. Below e = 1 this is the loss "viscous".
- `yielding`: elastic-plastic. Below e = 1 this is the loss "plastic".

The functions of `kelvin_voigt` and `yielding` are those of the law alone: restitution, its inverse,
and the largest force. They take and return arrays of one shape; they take a restitution from
`LEAST_RESTITUTION` to 1 where they say nothing else. `planarimpact.bodies` gives them in SI units.
`planarimpact.continuum` adds the springs of micro-slip.

Units, except in `hertz`: E* = 1, R = 1, m2 = 1, |v2(0)| = 1, so that Hertz's force is
(4/3) d^(3/2) at the approach d. The unit of length is (m2 v2(0)^2/(E* R^(1/2)))^(2/5).
"""

from planarimpact.normal_impact import hertz, kelvin_voigt, yielding

__all__ = ["LEAST_RESTITUTION", "hertz", "kelvin_voigt", "yielding"]
# The inverses and forces of both laws hold from here. The viscous tables end at e = 0.0216.
LEAST_RESTITUTION = 0.022
