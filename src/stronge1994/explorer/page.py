"""Write the impact explorer: one page that solves by itself and needs no other file."""

import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias
from urllib.parse import urlencode

from markupsafe import Markup, escape

from planarimpact import bodies, collision
from stronge1994.pages import templates
from stronge1994.reference_data import strict_yaml

State: TypeAlias = dict[str, Any]  # of the controls, by their names

# Each slider has a smallest value, a largest value and a step.
LIMITS = {
    "angle": (0, 89.9, 0.1),  # deg
    "friction": (0.01, 2, 0.01),  # for mu = 0 velocities over mu v2(0) have no meaning
    "restitution": (0, 1, 0.01),
    "poisson_ratio": (0, 0.5, 0.005),
    "mass_ratio": (1, 10, 0.05),
    "speed": (0.5, 12, 0.1),  # m/s
    "spin": (-400, 400, 5),  # rad/s
    "table": (0, 2, 0.05),  # m
    "compliance": (0, 1, 0.01),  # along the surface, over that of the body
    "radius": (1, 200, 1),  # mm
    "gravity": (0, 30, 0.01),  # m/s^2
}
# The controls that a figure of the paper sets; the others are as the page opens.
OF_FIGURES = ["angle", "friction", "restitution", "poisson_ratio", "mass_ratio"]
BODIES = {
    "solid sphere": bodies.solid_sphere(radius=1.0, density=1.0),
    "thin shell": bodies.thin_shell(radius=1.0, mass=1.0),
    "disc": bodies.disc(radius=1.0, mass=1.0),
}


def presets(settings: Mapping[str, Any]) -> dict[str, State]:
    """States of the page's controls for figures, where the sliders reach them."""
    states = {}
    for figure, own in settings["figures"].items():
        friction = own.get("friction", own["open"].get("friction"))
        friction = max(friction) if isinstance(friction, list) else friction
        angle = own["open"].get("angle")
        if angle is None:
            angle = math.degrees(math.atan(friction * own["incidence"]))
        restitution = own.get("restitution", 1.0)
        if isinstance(restitution, list):  # the middle one; the first of two
            restitution = restitution[(len(restitution) - 1) // 2]
        zeta2, beta = settings["stiffness_ratio"], settings["mass_ratio"]
        values = angle, friction, restitution, _poisson_ratio(zeta2), beta
        rounded = (round(float(value), 4) for value in values)
        state = dict(zip(OF_FIGURES, rounded, strict=True))
        if all(LIMITS[name][0] <= value <= LIMITS[name][1] for name, value in state.items()):
            states[figure] = state
    return states


def _poisson_ratio(stiffness_ratio: float) -> float:
    """nu of zeta^2 = (2 - nu)/(2 (1 - nu)); NaN where no material has it."""
    return (stiffness_ratio - 1) / (stiffness_ratio - 0.5) if stiffness_ratio > 0.5 else math.nan


def address(state: Mapping[str, float]) -> str:
    """The part of the page's address after #, without the chosen chart.

    >>> address({"angle": 58.0, "friction": 0.2})
    'angle=58&friction=0.2'
    """
    return "&".join(f"{control}={value:g}" for control, value in state.items())


def balls(text: str) -> list[dict[str, str]]:
    """The balls of materials.yaml: name, address, and what the page says about their numbers.

    >>> balls("balls: [{name: a, state: {friction: 1e-1}, source: measured, caveat: It yields.}]")
    [{'name': 'a', 'address': 'friction=0.1', 'about': 'It yields. Numbers: measured.'}]
    """
    return [_ball(**ball) for ball in strict_yaml.load(text)["balls"]]


def _ball(
    name: str, state: State, source: str = "", caveat: str = "", preset: str = ""
) -> dict[str, str]:
    """One ball; the numbers and words of a preset of the package come with it."""
    if preset:
        given = collision.presets()[preset]
        pair, body = given.pair, given.body
        state = {
            "friction": float(pair.friction),
            "restitution": float(pair.restitution),
            "poisson_ratio": round(float(_poisson_ratio(float(pair.stiffness_ratio))), 4),
            "mass_ratio": f"{float(bodies.mass_ratio(body)):g}",
            "radius": f"{1000 * float(body.radius):.3g}",
            **state,
        }
        source, caveat = given.source, f"{caveat} {given.caveat}"
    about = str(escape(f"{caveat} Numbers: {source}.".strip()))
    return {"name": name, "address": urlencode(state), "about": about}


def page(settings: Mapping[str, Any], sources: Sequence[str], answers: Sequence[Any]) -> str:
    """The page as text, from the template explorer.html and the files in the same folder."""
    texts = {Path(path).name: Markup(Path(path).read_text(encoding="utf-8")) for path in sources}
    template = templates.environment(Path(sources[0]).parent).get_template("explorer.html")
    return template.render(
        limits=LIMITS,
        presets={figure: address(state) for figure, state in presets(settings).items()},
        bodies={name: round(float(bodies.mass_ratio(body)), 12) for name, body in BODIES.items()},
        materials=balls(str(texts["materials.yaml"])),
        sources=texts,
        answers=Markup(json.dumps(answers)),
    )
