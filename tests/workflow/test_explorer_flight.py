"""The balls of the explorer fly and bounce as mechanics says, and the stage shows them."""

import functools
import itertools
import json
import math
import re
from pathlib import Path
from urllib.parse import parse_qsl

import numpy as np
import pytest
import yaml

from planarimpact import lumped
from stronge1994 import settings
from stronge1994.explorer import page as write_explorer
from tests.workflow import node
from tests.workflow.project import config

CONTACT = "(x) => ({ state: solver.rebound(x, one.mass_ratio, 1.2, one.restitution) })"
# Each flight with the ball at nine instants.
PATHS = f"""(one) => flight.fly(one, {CONTACT}).map((part) => part.kind === "bounce" ? part : {{
  ...part, ways: [...Array(9).keys()].map((i) => flight.later(part.ball, i / 8 * part.time)) }})"""


def thrown():
    """Throws over the sliders, with a table and without, with gravity and without."""
    rng = np.random.default_rng(1969)
    limits = {name: limit[:2] for name, limit in write_explorer.LIMITS.items() if name != "table"}
    rows = [{name: rng.uniform(*limit) for name, limit in limits.items()} for _ in range(60)]
    for i, row in enumerate(rows):
        row |= {"radius": 0.025, "gravity": [9.81, 0][i % 3 == 0], "table": [0, 0.7][i % 2]}
        row["restitution"] = max(row["restitution"], 0.2)
    rows[54]["angle"] = 0.0  # it is dropped, and bounces once
    return rows


THROWS = thrown()


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


# The bounces of both balls of a throw, of which the lower one has a share of its compliance.
BOUNCES = """(given, share) => {
  const groups = { mu: given.friction, beta: given.mass_ratio, zeta2: (given.zeta2 ?? 1.5) * share,
    e: given.restitution };
  const bounces = (style) =>
    flight.bounces(flight.fly(given, (x) => models.contact(style, { ...groups, x })));
  return { upper: bounces("rigid"), lower: bounces("lumped"),
    given: { ...given, groups, compliance: share } };
}"""
TOLD = f"""([given, share]) => {{
  const both = ({BOUNCES})(given, share);
  return [0, 1].map((over) => words.story(both, both.lower.length, over === 1, share > 0)).concat(
    [both.upper, both.lower].map((all) => all.map((one) => [one.x, one.contact.state.velocity,
      one.ball.along, one.after.along, Math.min(...one.contact.rows.map((row) => row.velocity)),
      one.contact.rows.some((row) => row.sticks)])));
}}"""


def test_a_story_is_true_of_every_throw(scripts):
    rng, endings = np.random.default_rng(1983), {"came back": 0, "went on, too": 0, "Both balls": 0}
    throws = [(one, share) for one in THROWS for share in (0.0, rng.uniform(0.05, 1), 1.0)]
    for said, ending, upper, lower in scripts.map(TOLD, throws):
        x, w, before, after, least, stuck = lower[-1]
        own = said.partition(" Without: ")[0].partition("Both: ")
        own = own[2] or own[0]
        reversed_, swung = w < -0.0005 * x, least < -0.0005 * x
        assert ("recoiled and threw" in own) == (stuck and reversed_ and "With the" in said)
        assert ("and then forwards again" in own) == (stuck and swung and w > 0.0005 * x)
        assert ("slipped throughout" in own) == (not stuck)
        if "threw" in own:
            percents = f"{100 * abs(w / x):.{int(abs(w / x) < 0.095)}f}"
            assert f"at {percents}\u00a0% of the speed it came with" in own
        rigid = upper[len(lower) - 1][3]
        if " Without: " in said and abs(rigid) >= 0.05:
            assert f"{abs(rigid):.1f} m/s " in said.partition(" Without: ")[2]
        if abs(after) >= 0.05:
            assert f"{abs(after):.1f} m/s {'forwards' if after > 0 else 'backwards'}" in own
            assert ("sets off, " in own) == (abs(before) < 0.05)
            assert ("turns round" in own) == (before * after < 0 and abs(before) >= 0.05)
        for words in endings:
            endings[words] += words in ending
        if "came back" in ending:
            # The rigid one goes on throughout; the other one turns once, after the first bounce.
            ways = [one[3] > 0 for one in lower]
            assert all(one[3] > 0 for one in upper) and ways[0] and not ways[-1]
            assert ways == sorted(ways, reverse=True) and all(one[1] < 0 for one in lower)
    assert min(endings.values()) > 0, endings


def test_of_one_ball_alone_only_its_own_is_told(scripts):
    alone = TOLD.replace("share > 0)", "share > 0, true)")
    for said, ending, *_ in scripts.map(alone, [(one, 1.0) for one in THROWS]):
        assert said == ending and re.match(r"After bounce \d \(\w+\)\. [A-Z]", said)
        assert not re.search("Without|lower", said)


def menu():
    """Every ball and figure of the menu on floor and under a table, with spins, for all e."""
    names = ("angle", "friction", "restitution", "poisson_ratio")
    opening = dict(mass_ratio=3.5, speed=5, spin=0, table=0, radius=25, gravity=9.81, compliance=1)
    text = (node.FOLDER / "materials.yaml").read_text(encoding="utf-8")
    presets = write_explorer.presets(settings.of_explorer(config()))
    found = [ball["address"] for ball in write_explorer.balls(text)]
    found += map(write_explorer.address, presets.values())
    for address in found:
        own = opening | {name: float(one) for name, one in parse_qsl(address)}
        assert set(names) <= set(own)
        nu = own.pop("poisson_ratio")
        own |= {"zeta2": (2 - nu) / (2 * (1 - nu)), "radius": own["radius"] / 1000}
        for table, spin, e in itertools.product(
            {0.0, 0.7, own["table"]},
            {-200.0, 0.0, 200.0, own["spin"]},
            {0.0, 0.3, own["restitution"], 1.0},
        ):
            yield own | {"table": table, "spin": spin, "restitution": e}


def velocities(given, reverse):
    """Velocities along the floor after each bounce; `reverse` is v1 after a bounce, over mu v2."""
    gap = given["table"] - 2 * given["radius"] if given["table"] > 4 * given["radius"] else 0
    angle, g, radius = math.radians(given["angle"]), given["gravity"], given["radius"]
    along, up = given["speed"] * math.sin(angle), given["speed"] * math.cos(angle)
    spun, on_floor, found = radius * given["spin"], True, []  # r times the spin, clockwise
    while len(found) < (3 if gap else 5) and (up >= 0.3 or not found):
        side = -1 if on_floor else 1
        unit = given["friction"] * up
        change = unit * reverse((along + side * spun) / unit) - (along + side * spun)
        along += change / given["mass_ratio"]
        spun += side * (1 - 1 / given["mass_ratio"]) * change
        found.append(along)
        up *= given["restitution"]
        if not up:
            break
        if gap and not (on_floor and up**2 <= 2 * g * gap):
            up = math.sqrt(up**2 + (-2 if on_floor else 2) * g * gap)
            on_floor = not on_floor
    return found


def springs(given, share):
    """The same, with a share of the tangential compliance of the ball."""
    zeta2 = share * given["zeta2"]
    solve = functools.partial(lumped.rebound, mass_ratio=given["mass_ratio"], stiffness_ratio=zeta2)
    return velocities(
        given,
        lambda x: (
            math.copysign(1, x) * float(solve(abs(x), restitution=given["restitution"]).velocity)
        ),
    )


def test_a_ball_leaves_each_bounce_as_the_package_says(scripts):
    """Along the floor: a wrong spin, wall or height would change it at the next bounce."""
    counts = []
    for given, parts in zip(THROWS, scripts.map(PATHS, THROWS), strict=True):
        found = [bounce["after"]["along"] for bounce in parts[1::2]]
        own = springs(given | {"zeta2": 1.2}, 1.0)
        assert found == pytest.approx(own[: len(found)], abs=1e-9)
        counts.append(len(found))
    assert min(counts) > 0 and sum(counts) > 100


def test_the_last_sentence_is_true_by_what_happened_and_by_what_could_happen(scripts):
    """Each entry of the menu: what turns a ball that went on, and that nothing can."""
    throws = list(itertools.product(menu(), (1.0, 0.5)))
    counts = dict.fromkeys(("Timing decides", "No spring can", "came back", "Under a table"), 0)
    chance = np.random.default_rng(7)
    for (given, share), told in zip(throws, scripts.map(TOLD, throws), strict=True):
        ending = told[1]
        for words in counts:
            counts[words] += words in ending
        if "went on, too" in ending:
            assert min(springs(given, share)) > 0.05
            other = re.search(r"compliance ([\d.]+) the spring", ending)
            least = re.search(r"at least ([\d.]+) m/s", ending)
            assert bool(other) != bool(least)
            if under := re.search(r"Under a table at ([\d.]+) m it comes back", ending):
                assert springs(given | {"table": float(under[1])}, share)[-1] < -0.05
            if other:
                assert springs(given, float(other[1]))[-1] < -0.05
            kept = [
                min(velocities(given, lambda x, one=one: x * (1 - 2 * next(one))))
                for shares in [*itertools.product((0, 1), repeat=3), *chance.random((20, 3))]
                for one in [itertools.cycle(shares)]
            ]
            if least:
                assert min(kept) > float(least[1]) - 0.051
            # On a bare floor a ball without spin keeps at least 3/7.
            if not given["table"] and not given["spin"] and given["mass_ratio"] == 3.5:
                along = given["speed"] * math.sin(math.radians(given["angle"]))
                assert float(least[1]) == pytest.approx(3 / 7 * along, abs=0.051)
        elif "came back" in ending:
            assert springs(given, share)[-1] < -0.05 and given["table"]
    assert min(counts.values()) > 0, counts


def test_a_show_ends_soon(scripts):
    """However small gravity is, or the velocity towards a wall."""
    slow = {"angle": 89.9, "speed": 0.5, "spin": 0, "friction": 0.8, "mass_ratio": 3.5}
    slow |= {"restitution": 0.01, "table": 2, "radius": 0.025}
    throws = [slow | {"gravity": g} for g in (0, 0.1)]
    throws += [one | {"angle": 10, "speed": 12, "restitution": 1, "table": 0} for one in throws]
    longest = (
        "(one) => flight.fly(one, (x) => ({ state: solver.rebound(x, 3.5, 1.5, one.restitution)"
    )
    for times in scripts.map(f"{longest} }})).map((part) => part.time ?? 0)", throws):
        assert max(times) <= 6 and len(times) > 2


# What is drawn of a throw at a share of its show, or where that is negative of its contacts.
SHOWN = """([given, share]) => {
  for (const id in drawn) delete drawn[id];
  const groups = (x) => (
    { x, mu: given.friction, beta: given.mass_ratio, zeta2: 1.2, e: given.restitution });
  const fly = (style) => flight.fly(given, (x) => models.contact(style, groups(x)));
  stage.prepare({ ...given, groups: groups(0) }, { upper: fly("rigid"), lower: fly("lumped") });
  const lens_at = (now) => (stage.show(now), drawn["stage-lower-lens"].innerHTML);
  const times = [...Array(401).keys()].map((i) => (i / 400) * stage.duration());
  const some = share < 0 ? times.filter(lens_at) : times;
  stage.show(some[Math.floor(Math.abs(share) * (some.length - 1))]);
  return JSON.parse(JSON.stringify(drawn));
}"""
LOOKED_AT = Path(__file__).with_name("explorer.yaml")


def test_the_stage_is_the_one_that_was_looked_at(scripts):
    """After a change that is meant, empty the file, run this, and look at the explorer."""
    shares, found = [0, -0.2, -0.4, -0.6, -0.8, 1], []
    throws = list(zip(THROWS[:6], shares, strict=True))
    for share, drawn in zip(shares, scripts.map(SHOWN, throws), strict=True):
        for name, part in sorted(drawn.items()):
            words = [text for key, text in part.items() if key == "textContent"]
            words += [key for key, on in part.items() if on is True] + list(part["style"].values())
            numbers = np.array(re.findall(r"-?\d+\.?\d*", json.dumps(part)), float)
            # Two sums, which tell a change of any number or of their order.
            sums = [numbers.sum(), numbers @ np.cos(np.arange(numbers.size))]
            found.append([f"{share}: {name}", " ".join(words), *np.round(sums, 1).tolist()])
    if not (stored := yaml.safe_load(LOOKED_AT.read_text(encoding="utf-8"))):
        text = yaml.safe_dump(found, default_flow_style=None, width=1000)
        LOOKED_AT.write_text(text, encoding="utf-8")
    assert [words for *words, _, _ in found] == [words for *words, _, _ in stored]
    for (name, _, *sums), (*_, one, other) in zip(found, stored, strict=True):
        assert sums == pytest.approx([one, other], rel=1e-4, abs=0.2), name
