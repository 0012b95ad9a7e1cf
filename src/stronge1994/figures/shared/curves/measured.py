"""Models beside a measured series: what workflow/your_model_your_data.md needs of a figure."""

from collections.abc import Mapping, Sequence

from planarimpact.models import get
from stronge1994.csv_tables import Curves
from stronge1994.figures.shared.curves import shots


def curves(
    experiment: Mapping[str, float],
    models: Sequence[str],
    samples: int,
    tolerance: float,
    uncertainty: Mapping[str, float] | None = None,
) -> Curves:
    """A curve of each model, with the parameters of an experiment: a sphere shot without spin.

    Beside each stand curves with one parameter off by one sigma. `tolerance` is that of a
    continuum.

    >>> sphere = {"mass_ratio": 3.5, "stiffness_ratio": 1.2, "restitution": 0.9, "friction": 0.1}
    >>> named = curves(sphere, ["rigid"], 9, 1e-3)
    >>> float(named["rigid"]["tangential_restitution [1]"][0])
    -0.0
    """
    named: Curves = {}
    for name in models:
        model = get(name)
        own = {"tolerance": tolerance} if "tolerance" in model.settings else {}
        every = shots.shots(name, samples, (), experiment, uncertainty or {})
        for curve, shot in every.items():
            rebound = model.rebound(shot.x, *shots.groups(shot.sphere), **own)
            share = -rebound.velocity / shot.x
            named[curve] = shots.measured(shot, rebound) | {"tangential_restitution [1]": share}
    return named
