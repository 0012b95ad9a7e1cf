"""The balls of the explorer fly and bounce as mechanics and the package say."""

import math

import numpy as np
import pytest

from planarimpact import lumped
from stronge1994.explorer import page as write_explorer

CONTACT = "(x) => ({ state: solver.rebound(x, one.mass_ratio, 1.2, one.restitution) })"
# Each bounce with what is said about it, each flight with the ball at nine instants.
PATHS = f"""(one) => flight.fly(one, {CONTACT}).map((part) => part.kind === "bounce" ? {{
  ...part, said: words.centre({{ ...part, before: part.ball, e: one.restitution }}) }} : {{
  ...part, ways: [...Array(9).keys()].map((i) => flight.later(part.ball, i / 8 * part.time)) }})"""


def thrown():
    """Throws over the sliders, with a table and without, with gravity and without."""
    rng = np.random.default_rng(1969)
    limits = {name: limit[:2] for name, limit in write_explorer.LIMITS.items() if name != "table"}
    rows = [{name: rng.uniform(*limit) for name, limit in limits.items()} for _ in range(60)]
    for i, row in enumerate(rows):
        row |= {"radius": 0.025, "gravity": [9.81, 0][i % 3 == 0], "table": [0, 0.7][i % 2]}
        row["restitution"] = max(row["restitution"], 0.2)
    return rows


THROWS = thrown()


def test_a_bounce_keeps_what_mechanics_keeps(scripts):
    walls = []
    for given, parts in zip(THROWS, scripts.map(PATHS, THROWS), strict=True):
        e, radius = given["restitution"], given["radius"]
        inertia = radius**2 / (given["mass_ratio"] - 1)
        kinds = ["flight", "bounce"] * len(parts)
        assert [part["kind"] for part in parts] == kinds[: len(parts)]
        for part in parts[1::2]:
            before, after, wall = part["ball"], part["after"], part["wall"]
            walls.append(wall)
            arm = -radius if wall == "floor" else radius  # from the centre up to the contact
            # Friction and normal force act at the contact: about it, no angular momentum changes.
            turning = inertia * (after["spin"] - before["spin"])
            assert turning == pytest.approx(arm * (after["along"] - before["along"]), abs=1e-9)
            energies = [
                one["along"] ** 2 + one["up"] ** 2 + inertia * one["spin"] ** 2
                for one in (before, after)
            ]
            assert energies[1] <= energies[0] * (1 + 1e-12)
            assert after["up"] == pytest.approx(-e * before["up"], rel=1e-12)
            assert (after["up"] > 0) == (wall == "floor")
            turns = before["along"] * after["along"] < 0 and abs(after["along"]) > 0.005
            assert ("turns back" in part["said"]) == turns
            angle = math.degrees(math.atan2(abs(after["along"]), after["up"]))
            assert f" at {angle:.0f}° to" in part["said"]
            # The package says the same of the contact point.
            unit = given["friction"] * abs(before["up"])
            point, point_after = (one["along"] + arm * one["spin"] for one in (before, after))
            found = lumped.rebound(point / unit, given["mass_ratio"], 1.2, e).velocity
            assert point_after / unit == pytest.approx(found, abs=1e-9 * max(1, abs(point / unit)))
    assert len(walls) > 100 and set(walls) == {"floor", "table"}


def test_a_ball_flies_with_gravity_between_floor_and_table(scripts):
    for given, parts in zip(THROWS, scripts.map(PATHS, THROWS), strict=True):
        gap = given["table"] - 2 * given["radius"] if given["table"] else math.inf
        for flight, bounce in zip(parts[::2], parts[1::2], strict=False):
            start, end = flight["ball"], bounce["ball"]
            t = np.linspace(0, flight["time"], 9)
            heights = start["height"] + start["up"] * t - start["gravity"] * t**2 / 2
            assert np.abs([one["height"] for one in flight["ways"]] - heights).max() < 1e-9
            assert heights.min() > -1e-9 and heights.max() < gap + 1e-9
            assert end["height"] == pytest.approx(0 if bounce["wall"] == "floor" else gap, abs=1e-9)
            assert end["place"] == pytest.approx(start["place"] + start["along"] * t[-1])
            assert end["turn"] == pytest.approx(start["turn"] + start["spin"] * t[-1])
            energy = [one["up"] ** 2 / 2 + start["gravity"] * one["height"] for one in (start, end)]
            assert energy[0] == pytest.approx(energy[1], rel=1e-9)


def test_the_aim_is_the_throw(scripts):
    pairs = scripts.map("(one) => [flight.aimed(flight.start(one)), flight.first(one)]", THROWS)
    for given, (aimed, first) in zip(THROWS, pairs, strict=True):
        for name in ("angle", "speed"):
            assert aimed[name] == pytest.approx(given[name], rel=1e-9)
        angle = math.degrees(math.atan2(first["along"], -first["up"]))
        assert angle == pytest.approx(given["angle"], rel=1e-9)


def test_a_ball_that_does_not_bounce_stays_on_the_floor(scripts):
    (parts,) = scripts.map(PATHS, [THROWS[0] | {"restitution": 0, "spin": 0}])
    assert [part["kind"] for part in parts] == ["flight", "bounce", "flight"]
    assert abs(parts[2]["ball"]["up"]) == parts[2]["ball"]["height"] == 0
