"""Which model for a pair of materials: errors and times of every model that fits."""

from __future__ import annotations

import time
from collections.abc import Sequence
from contextlib import suppress
from copy import deepcopy
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from planarimpact import bodies, continuum, models
from planarimpact.bodies import Material
from planarimpact.common import checks, sliding
from planarimpact.common.arrays import SMALLEST, Array
from planarimpact.common.cautions import Caution
from planarimpact.common.losses import SPHERES
from planarimpact.common.records import record

if TYPE_CHECKING:  # only who wants a DataFrame needs it
    import pandas as pd

BETA = 3.5  # m2/m1 of a solid sphere, whatever the densities and sizes
POINTS, COPIES = 65, 16  # incidences that are solved, and of those of a quick model in its array
TOLERANCE = 1e-3  # of the continuum, in mu v2(0)
COLUMNS = (
    "model",
    "loss",
    "speed_error [%]",
    "tangential_error [%]",
    "angle_error [deg]",
    "time_alone [us]",
    "time_in_array [us]",
)


@record
class Comparison(NamedTuple):
    """Models for a pair of materials, the nearest to the continuum first.

    Attributes
    ----------
    columns : dict of str to list
        What `compare` says, an entry a model.
    notes : list of str
        What is compared, and where its numbers come from.
    """

    columns: dict[str, list[Any]]
    notes: list[str]

    def table(self) -> pd.DataFrame:
        """The columns as a DataFrame; it needs pandas."""
        import pandas as pd

        return pd.DataFrame(self.columns)


@checks.default_errors
def compare(
    material: str | Material,
    on: str | Material | None = None,
    *,
    friction: float,
    angle: Sequence[float] = (0, 80),
    restitution: float | None = None,
    loss: str | None = None,
) -> Comparison:
    """Errors and times of the models that fit a pair of materials.

    A solid sphere without spin strikes a body at rest. Errors are those of the motion of its centre
    afterwards, against the continuum with the same restitution and loss. Each is the largest at 65
    incidences, evenly over those in the range where not all models slip throughout. Densities,
    sizes and speed change none. Models for e = 1 alone are left out, and those that refuse the
    pair.

    Parameters
    ----------
    material, on : str or Material
        Of the sphere and of what it strikes: names of `materials()`, or moduli. Without `on` that
        is a rigid body.
    friction : float
        Coefficient mu, above 0.
    angle : (float, float)
        Least and largest angle of incidence [degrees from the normal], 0 to 90.
    restitution : float, optional
        e, 0.1 to 1; needed if none is known of the softer material.
    loss : str, optional
        "viscous" or "plastic"; needed if the softer material has no name.

    Returns
    -------
    Comparison
        With the columns model; loss; speed_error [%] and tangential_error [%], of the speed and of
        the velocity along the surface, as shares of those of the continuum; angle_error [deg], of
        the angle of rebound; time_alone [us] and time_in_array [us] of one impact, alone and among
        1040 (for the continuum, with tolerance 1e-3, among 65), measured on the spot. The continuum
        with the other loss has in its row what that would change.

    Examples
    --------
    >>> table = compare("steel", "steel", friction=0.1, angle=(0, 60)).table().set_index("model")
    >>> table["angle_error [deg]"][["continuum.plastic", "rigid"]].round(1).tolist()
    [0.0, 2.7]
    """
    roles = {"material": material} if on is None else {"material": material, "on": on}
    pair = [_moduli(*one) for one in roles.items()]
    mu = checks.number("friction", friction, "finite numbers above 0", checks.LEAST)
    rule = "two numbers from 0 to 90 degrees"
    ends = checks.checked("angle", angle, rule, 0, 90)
    if ends.shape != (2,):
        raise checks.InputError(f"angle, shape {ends.shape}: allowed are {rule}")
    softer = list(roles.values())[np.argmin([float(one.young_modulus) for one in pair])]
    known_e, source_of_e = _known("restitution", restitution, softer)
    known_loss, source_of_loss = _known("loss", loss, softer)
    least = continuum.LEAST_RESTITUTION
    e = checks.number("restitution", known_e, f"numbers from {least:g} to 1", least, 1)
    finest = f"continuum.{checks.loss(known_loss, SPHERES)}"
    groups = BETA, float(bodies.stiffness_ratio(*pair)), e
    limits = [float(continuum.slip_throughout_limit(*groups, loss=name)) for name in SPHERES]
    end = max(*limits, sliding.change(BETA, e))
    first, last = np.minimum(np.tan(np.radians(ends)) / mu, end)
    x = np.linspace(first, last, POINTS)

    def solved(name: str) -> tuple[Array, list[float]]:
        """Speed and tangential velocity of the centre in v2(0), angle of rebound; both times."""
        times, slow = [], models.MODELS[name].cost == "steps and springs"
        settings = {"tolerance": TOLERANCE} if slow else {}
        for incidences in (x[POINTS // 4], x if slow else np.tile(x, COPIES)):
            taken = []
            for _ in range(1 if slow else 3):
                start = time.perf_counter()
                velocity = models.rebound(name, incidences, *groups, **settings).velocity
                taken.append(time.perf_counter() - start)
            times.append(1e6 * min(taken) / incidences.size)
        along = mu * (x + (velocity[:POINTS] - x) / BETA)
        return np.array([np.hypot(along, e), along, np.degrees(np.arctan2(along, e))]), times

    found = {finest: solved(finest)}
    for name, model in models.MODELS.items():
        if name != finest and model.restitution[0] <= e and model.restitution[0] < 1:
            with suppress(checks.InputError, checks.ConvergenceError):  # it refuses the pair
                found[name] = solved(name)
    exact = found[finest][0]
    units = [exact[0] / 100, np.maximum(exact[1] / 100, SMALLEST), np.ones(POINTS)]
    rows = [
        (name, models.MODELS[name].loss, *np.max(np.abs(motion - exact) / units, axis=1), *times)
        for name, (motion, times) in found.items()
    ]
    rows.sort(key=lambda row: float(row[3]))
    columns = {name: [*cells] for name, cells in zip(COLUMNS, zip(*rows, strict=True), strict=True)}
    dissimilar = abs(float(bodies.dundurs(*pair))) > bodies.COUPLING * mu
    caution = Caution.of(str(known_loss), mu, e, dissimilar).text
    named = {one: known for one, known in _materials().items() if one in roles.values()}
    notes = [
        f"{material} on {'a rigid body' if on is None else on}: stiffness ratio {groups[1]:.3g}; "
        f"restitution {e:g}, {source_of_e}; loss {known_loss}, {source_of_loss}",
        *(
            f"{one}: {field} {known[field]['value']:g}, {known[field]['source']}"
            for one, known in named.items()
            for field in Material._fields
        ),
        *([f"caution: {caution}"] if caution else []),
        "a solid sphere without spin; errors: the largest of the motion of its centre after the "
        f"impact, against {finest}; the continuum with the other loss shows what that would change",
    ]
    return Comparison(columns, notes)


def materials() -> dict[str, dict[str, dict[str, Any]]]:
    """Materials by name: each value with its source. Moduli of handbooks are uncertain.

    Examples
    --------
    >>> materials()["alumina"]["restitution"]
    {'value': 0.98, 'source': 'on soda-lime glass, at 3.9 m/s (data/kharaz2001)'}
    """
    return deepcopy(_materials())


@cache
def _materials() -> dict[str, dict[str, dict[str, Any]]]:
    """Materials by name, of which nobody gets the original."""
    import tomllib  # here, as most programs do without materials
    from importlib import resources

    text = resources.files(__package__).joinpath("materials.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)


def _moduli(role: str, given: str | Material) -> Material:
    """A material by its name, or as it is."""
    if isinstance(given, Material):
        for field, value in given._asdict().items():
            checks.number(f"{role}.{field}", value, "one number")
        return given
    values = _materials()[checks.word(role, given, _materials())]
    return Material(*(values[field]["value"] for field in Material._fields))


def _known(name: str, given: Any, material: str | Material) -> tuple[Any, str]:
    """A property of a pair and its source: as given, or as known of the softer material."""
    if given is not None:
        return given, "as given"
    known = _materials().get(material, {}) if isinstance(material, str) else {}
    if name not in known:
        raise checks.InputError(f"{name}: none is known here of {material}, give one")
    return known[name]["value"], known[name]["source"]
