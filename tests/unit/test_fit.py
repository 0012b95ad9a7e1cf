"""Laws of discrete-element codes, fitted: each law as its code has it, the lines, the errors."""

import csv
import functools
import importlib.util
import math
import re
from pathlib import Path

import numpy as np
import pytest

from planarimpact import InputError, bodies, fit
from planarimpact.fit import laws
from planarimpact.models import timestep
from stronge1994.figures.trade import peers

ROOT = Path(__file__).parents[2]
LAWS = {
    (name, style): law for name, code in fit.CODES.items() for style, law in code.styles.items()
}
GLASS = bodies.Material(70e9, 0.25)
SPHERE = {"radius": 0.002, "density": 2500.0, "friction": 0.2, "speed": 1.0}


@functools.cache
def measure():
    """The script that measures in LAMMPS."""
    spec = importlib.util.spec_from_file_location("measure", ROOT / "data/lammps/measure.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@functools.cache
def found(law, pair):
    """A fit of a pair of the figure."""
    settings = measure().settings()
    about = settings["pairs"][pair]
    zeta2 = float(bodies.stiffness_ratio(bodies.Material(1.0, about["poisson_ratio"])))
    groups = 3.5, zeta2, about["restitution"]
    return fit.fit(law, *groups, loss=about["loss"], incidence_max=settings["incidence_max"])


@pytest.mark.parametrize(
    ("law", "other"),
    [
        (laws.Law(), timestep.linear),
        (laws.Law(hertzian=True), timestep.mindlin),
        (laws.Law(hertzian=True, rescales=True, limited=True), timestep.mindlin_rescaled),
    ],
)
def test_without_loss_a_law_is_that_of_models(law, other):
    x = np.linspace(0, 8, 41)
    velocity = laws.rebound(law, x, 3.5, 14 / 17, 0.0, told=1.0, steps=64)
    np.testing.assert_allclose(velocity, other(x, 3.5, 17 / 14, steps=64).velocity, atol=1e-12)


@pytest.mark.parametrize("law", LAWS.values(), ids=map(str, LAWS))
@pytest.mark.parametrize("e", [1.0, 0.8, 0.3])
def test_every_law_has_the_restitution_that_is_asked_for(law, e):
    told = laws.told_for(law, e)
    assert laws.restitution(law, told, 4000) == pytest.approx(e, abs=3e-4)
    assert laws.restitution(law, told) == pytest.approx(e, abs=2e-3)
    # A contact that cannot pull slides throughout with mu times its normal impulse.
    if law.limited:
        slides = laws.rebound(law, np.array([1e3]), 3.5, 1.0, 0.0, told)
        assert slides == pytest.approx(1e3 - 3.5 * (1 + laws.restitution(law, told)), abs=1e-9)


def in_si(lines, x, mass, friction, speed, yade):
    """One contact as MercuryDPM or Yade steps through it, from the numbers of its input."""
    names = "kn cn ks cs" if yade else "Stiffness Dissipation SlidingStiffness SlidingDissipation"
    kn, cn, ks, cs = (
        float(re.search(rf"\b(?:set)?{name}[=(]([^,)]*)", lines)[1]) / (2 if yade else 1)
        for name in names.split()
    )
    step = float(re.search(r"(?:O\.dt = |setTimeStep\()([^)\n]*)", lines)[1])
    depth, v, w, spring = 0.0, speed, friction * x * speed, 0.0
    while True:
        depth += step * v
        if depth <= 0:
            return w / (friction * speed)
        normal = kn * depth + cn * v
        if yade:
            normal = max(normal, 0.0)
        limit = friction * abs(normal)
        spring += ks * step * w
        if yade and abs(spring) > limit:
            force = spring = math.copysign(limit, spring)
        elif yade:
            force = spring + cs * w
        elif abs(force := spring + cs * w) > limit:
            force = math.copysign(limit, force)
            spring = force - cs * w
        v -= step * normal / mass
        w -= step * 3.5 * force / mass


@pytest.mark.parametrize("law", ["mercurydpm", "yade"])
def test_the_lines_have_the_contact_of_the_fit(law):
    """By the loop of each code, a number at a time, in SI units, from the printed numbers."""
    one = found(law, "glass")
    lines = fit.lines(one, GLASS, **SPHERE)
    mass = float(bodies.solid_sphere(0.002, 2500.0).mass) / 2
    places = [7, 30, 60, 90]
    stepped = [in_si(lines, one.incidence[i], mass, 0.2, 1.0, law == "yade") for i in places]
    np.testing.assert_allclose(stepped, one.after[places], atol=1e-3)


def test_lammps_answered_as_the_laws_do():
    """The table that LAMMPS made with the lines, which the figure `fitted_laws` has too."""
    with open(ROOT / "data/lammps/rebound.csv", newline="") as file:
        rows = list(csv.reader(file))[1:]
    assert len(rows) == 252
    for curve, x, velocity in rows:
        pair, law, name = curve.split(", ")
        one = found(law, pair)
        place = int(np.abs(one.incidence - float(x)).argmin())
        assert getattr(one, name)[place] == pytest.approx(float(velocity), abs=5e-4), curve


@pytest.mark.skipif(bool(peers.missing("lammps")), reason="needs LAMMPS")
def test_lammps_answers_so_again():
    with open(ROOT / "data/lammps/rebound.csv", newline="") as file:
        rows = list(csv.reader(file))[1:]
    for stored, now in zip(rows, measure().rows(**measure().settings()), strict=True):
        assert stored[:2] == now[:2] and float(stored[2]) == pytest.approx(float(now[2]), abs=5e-4)


def test_readme_has_the_errors_before_and_after():
    text = (ROOT / "src/README.md").read_text(encoding="utf-8")
    table = re.search(r"\| pair \|(.*)\n\|[-|]*\n((?:\|.*\n)+)", text)
    codes = re.findall(r"`([a-z-]+)`", table[1])
    assert codes == list(fit.CODES)
    for row in table[2].splitlines():
        pair, *cells = (cell.strip() for cell in row.strip("|").split("|"))
        for law, cell in zip(codes, cells, strict=True):
            one = found(law, pair.split(",")[0])
            wanted = [one.error_before.rms, one.error.rms, one.error.largest]
            assert re.findall(r"\d\.\d+", cell) == [f"{error:.2f}" for error in wanted], (pair, law)


def test_the_nearest_is_the_nearest():
    one = found("lammps-hooke", "steel")
    law = LAWS["lammps-hooke", "linear_history"]

    def rms(stiffness, damping):
        velocity = laws.rebound(law, one.incidence, 3.5, stiffness, damping, one.told)
        return float(np.sqrt(np.mean((velocity - one.continuum) ** 2)))

    best = rms(one.stiffness, one.damping)
    assert best == pytest.approx(one.error.rms)
    for factor in (0.9, 0.97, 1.03, 1.1):
        assert rms(factor * one.stiffness, one.damping) > best
        assert rms(one.stiffness, factor * one.damping) > best


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"law": "granular"}, "law = 'granular': allowed are lammps-hertz-mindlin, lammps-hooke, "),
        ({"restitution": 0.2}, "restitution = 0.2: allowed are numbers from 0.3 to 1"),
        ({"loss": None}, "restitution = 0.8: .* unless loss says .*: viscous, plastic"),
        ({"stiffness_ratio": 0.0}, "stiffness_ratio = 0.0: allowed are numbers from 0.5 to 4"),
        ({"incidence_max": 0.0}, "incidence_max = 0.0: allowed are numbers above 0"),
    ],
)
def test_bad_input_is_refused(change, words):
    given = {"law": "yade", "restitution": 0.8, "loss": "viscous"} | change
    with pytest.raises(InputError, match=words):
        fit.fit(**given)


def test_lines_of_other_bodies_are_refused():
    with pytest.raises(InputError, match="stiffness_ratio = 1.5: allowed is .* 1.16667"):
        fit.lines(found("yade", "polyurethane"), GLASS, **SPHERE)
    with pytest.raises(InputError, match="speed = -1.0: allowed are finite numbers above 0"):
        fit.lines(found("yade", "glass"), GLASS, **SPHERE | {"speed": -1.0})
