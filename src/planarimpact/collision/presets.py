"""Presets: bodies with their pairs of materials, and the sources of their numbers."""

from functools import cache
from typing import Any, NamedTuple

from planarimpact import bodies
from planarimpact.bodies import Body, Material
from planarimpact.collision.pairs import Pair
from planarimpact.common.records import record


@record
class Preset(NamedTuple):
    """A body, what it touches, and where the numbers come from.

    Attributes
    ----------
    about : str
        The body and what it touches.
    body : Body
    pair : Pair
    source : str
        Where the numbers come from; it says which are typical or chosen, not measured.
    caveat : str
        Where the model does not hold.
    """

    about: str
    body: Body
    pair: Pair
    source: str
    caveat: str


def presets() -> dict[str, Preset]:
    """Presets by name.

    Examples
    --------
    >>> ball = presets()["superball"]
    >>> ball.about, round(float(ball.body.mass), 3), ball.pair.restitution.item()
    ('rubber ball on granite', 0.046, 0.9)
    """
    return dict(_presets())


@cache
def _presets() -> dict[str, Preset]:
    """Presets by name, of which nobody gets the original."""
    import tomllib  # here, as most programs do without presets
    from importlib import resources

    text = resources.files(__package__).joinpath("presets.toml").read_text(encoding="utf-8")
    return {name: _preset(**given) for name, given in tomllib.loads(text).items()}


def _preset(body: dict[str, Any], pair: dict[str, Any], **words: str) -> Preset:
    shape, nu = getattr(bodies, body.pop("shape")), pair.pop("poisson_ratio")
    modulus = pair.pop("young_modulus", None)
    if modulus is None:
        pair["stiffness_ratio"] = bodies.stiffness_ratio(Material(1.0, nu))  # of any modulus
        return Preset(body=shape(**body), pair=Pair(**pair), **words)
    material = Material(modulus, nu)
    return Preset(body=shape(**body), pair=Pair(material, material, **pair), **words)
