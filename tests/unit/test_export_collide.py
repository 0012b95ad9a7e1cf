"""Collisions in C and JavaScript: laws of mechanics over random impacts, and Python's answers."""

import re
import shutil
import subprocess

import numpy as np
import pytest

from planarimpact import Regime, collision, export, spheres
from planarimpact.bodies import Body

COUNT = 100_000
FIELDS = {"velocity": 3, "spin": 3, "other_velocity": 3, "other_spin": 3, "impulse": 3}
FIELDS |= {"incidence": 1, "restitution": 1, "error_bound": 1, "regime": 1, "model_form": 1}
FIELDS["told"] = 1  # whether a problem is
PAIR = "friction stiffness_ratio restitution relaxation_time yield_pressure effective_modulus loss"
BODY = "mass gyration radius"
LAWS = "relaxation_time", "yield_pressure"
COLUMNS = dict.fromkeys(PAIR.split(), 1) | {"normal": 3}
for who in ("", "other_"):
    COLUMNS |= {who + name: 1 for name in BODY.split()}
    COLUMNS |= {who + name: 3 for name in ("velocity", "spin")}
WIDTH = sum(COLUMNS.values())
STATES = [*range(13, 19), *range(22, 28)]  # the columns of velocities and spins
# What makes a good impact a bad one.
GOOD = {
    "friction": 0.3, "stiffness_ratio": 1.2, "restitution": 0.8, "loss": 2.0, "mass": 1.0,
    "gyration": 0.4**0.5, "radius": 1.0, "other_mass": np.inf, "other_gyration": np.inf,
    "normal": (0.0, 0.0, 1.0), "velocity": (0.1, 0.0, -1.0),
}  # fmt: skip
ACCEPTED = [{}, {"restitution": 1.0, "loss": 0.0}]
ACCEPTED += [{"normal": (0.0, 0.0, length)} for length in (0.999999, 1.000001)]
ACCEPTED += [{"friction": 1e308, "velocity": (0.1, 0.0, -2.0)}]
AWAY = {"velocity": (0.0, 0.0, 1.0)}
REFUSED = [
    *({name: np.nan} for name in (*GOOD, "spin", "other_velocity", "other_radius")),
    *({name: -1.0} for name in ("friction", "radius", "mass", "gyration", "restitution")),
    *({"normal": (0.0, 0.0, 1.01)}, {"velocity": (np.inf, 0.0, -1.0)}, {"mass": np.inf}),
    *({"restitution": 1.1}, {"loss": 0.0}, {"loss": 3.0}, {"yield_pressure": 1e9}),
    *({"stiffness_ratio": 3.0}, {"gyration": 0.1}),  # beyond the table
    {"restitution": 0.0, "loss": 0.0, "relaxation_time": 1.0, "effective_modulus": 1e9},
    *({"loss": code, "restitution": 1.0} for code in (3.0, -1.0)),
    # The same where nothing approaches.
    *({"normal": (0.0, 0.0, length)} | AWAY for length in (0.0, -2.0, 0.9999985, 1.0000015)),
    *({"loss": 3.0} | AWAY, {"friction": -1.0} | AWAY, {"restitution": 1.1} | AWAY),
    # Too large, or too small, to compute with.
    *({"velocity": (0.1, 0.0, -2.0), "mass": mass} for mass in (5e307, 5e-324)),
]
C = """\
#include <stdio.h>
#include "balls.h"
static struct balls_vector at(const double *x)
{
    struct balls_vector v = {x[0], x[1], x[2]};
    return v;
}
int main(void)
{
    double x[WIDTH], row[21];
    FILE *in = fopen("impacts", "rb"), *out = fopen("c", "wb"), *said = fopen("c.txt", "w");
    while (said && in && out && fread(x, sizeof x, 1, in) == 1) {
        struct balls_pair pair = {x[0], x[1], x[2], x[3], x[4], x[5], (int)x[6]};
        struct balls_body body = {x[10], x[11], x[12]}, other = {x[19], x[20], x[21]};
        struct balls_collision r = balls_collide(pair, at(x + 7), body, at(x + 13), at(x + 16),
            other, at(x + 22), at(x + 25));
        const char *problem = balls_problem(pair, at(x + 7), body, at(x + 13), at(x + 16),
            other, at(x + 22), at(x + 25));
        const struct balls_vector v[] = {
            r.velocity, r.spin, r.other_velocity, r.other_spin, r.impulse};
        int i;
        for (i = 0; i < 5; ++i) {
            row[3 * i] = v[i].x;
            row[3 * i + 1] = v[i].y;
            row[3 * i + 2] = v[i].z;
        }
        row[15] = r.incidence;
        row[16] = r.restitution;
        row[17] = r.error_bound;
        row[18] = r.regime;
        row[19] = balls_model_form(pair, at(x + 7), body, at(x + 13), at(x + 16), other,
            at(x + 22), at(x + 25));
        row[20] = problem != NULL;
        fwrite(row, sizeof row, 1, out);
        if (problem)
            fprintf(said, "%s\\n", problem);
    }
    return in && out && said ? fclose(out) || fclose(said) : 1;
}
"""
JAVASCRIPT = """\
import { readFileSync, writeFileSync } from "node:fs";
import { UNRESOLVED, collide, model_form } from "./balls.mjs";
const bytes = readFileSync("impacts"), rows = [], said = [];
const all = new Float64Array(bytes.buffer, bytes.byteOffset, bytes.length / 8);
const body = ([mass, gyration, radius]) => ({ mass, gyration, radius });
for (let i = 0; i < all.length; i += WIDTH) {
    const x = Array.from(all.subarray(i, i + WIDTH)), part = (from) => x.slice(from, from + 3);
    const [friction, stiffness_ratio, restitution, relaxation_time, yield_pressure,
        effective_modulus, loss] = x;
    const pair = { friction, stiffness_ratio, restitution, relaxation_time, yield_pressure,
        effective_modulus, loss };
    const contact = [pair, part(7), body(part(10)), part(13), part(16), body(part(19)), part(22),
        part(25)];
    try {
        const r = collide(...contact);
        rows.push(...r.velocity, ...r.spin, ...r.other_velocity, ...r.other_spin, ...r.impulse,
            r.incidence, r.restitution, r.error_bound, r.regime, model_form(...contact), 0);
    } catch (error) {
        if (!(error instanceof RangeError)) throw error;
        rows.push(...Array(18).fill(NaN), UNRESOLVED, NaN, 1);
        said.push(error.message);
    }
}
writeFileSync("js.txt", said.join("\\n"));
writeFileSync("js", new Uint8Array(Float64Array.from(rows).buffer));
"""
# What a caller of JavaScript forgets or mistakes, and how the message begins.
MISTAKES = {
    "[{ ...pair, loss: undefined }, up, ball, down, zero]": "pair.loss = undefined: ",
    "[{ ...pair, loss: 'viscous' }, up, ball, down, zero]": 'pair.loss = "viscous": ',
    "[{ ...pair, restitution: 1, loss: 'foo' }, up, ball, down, zero]": 'pair.loss = "foo": ',
    "[{ ...pair, restitution: 1, loss: null }, up, ball, zero, zero]": "pair.loss = null: ",
    "[{ ...pair, stiffness_ratio: '1.2' }, up, ball, down, zero]": "pair.stiffness_ratio = ",
    "[{ ...law, yield_pressure: '1e9' }, up, ball, down, zero]": "pair.yield_pressure = ",
    "[{ ...law, relaxation_time: true }, up, ball, down, zero]": "pair.relaxation_time = true: ",
    "[pair, up, { ...ball, mass: '1' }, down, zero]": 'body.mass = "1": ',
    "[{ ...pair, restitution: undefined }, up, ball, down, zero]": "pair.restitution = undefined: ",
    "[{ ...pair, restitution: '0.8' }, up, ball, down, zero]": 'pair.restitution = "0.8": ',
    "[{ ...pair, restitution: null }, up, ball, down, zero]": "pair.restitution = null: ",
    "[{ ...pair, friction: null }, up, ball, down, zero]": "pair.friction = null: ",
    "[{ ...pair, friction: undefined }, up, ball, down, zero]": "pair.friction = undefined: ",
    "[{ ...pair, stiffness_ratio: null }, up, ball, down, zero]": "pair.stiffness_ratio = null: ",
    "[{ friction: 1, stiffness_ratio: 1.5 }, up, ball, down, zero]": "pair = { friction: 1, ",
    "[undefined, up, ball, down, zero]": "pair = undefined: allowed is an object",
    "[pair, [0, 0, 2], ball, down, zero]": "normal = [0, 0, 2]: allowed is a vector whose length ",
    "[pair, { x: 0, y: 0, z: 1 }, ball, down, zero]": "normal = { x: 0, y: 0, z: 1 }: allowed is ",
    "[pair, up, ball, [0, -1], zero]": "velocity = [0, -1]: allowed is an array of three ",
    "[pair, up, ball, [0, 0, -1, 0], zero]": "velocity = [0, 0, -1, 0]: ",
    "[pair, up, ball, ['0', 0, -1], zero]": 'velocity = ["0", 0, -1]: ',
    "[pair, up, ball, down]": "spin = undefined: allowed is an array of three ",
    "[pair, up, { mass: 1, radius: 1 }, down, zero]": "body.gyration = undefined: ",
    "[pair, up, { ...ball, radius: null }, down, zero]": "body.radius = null: ",
    "[pair, up, ball, down, zero, null, zero, zero]": "other = null: allowed is an object",
}
CALLS = """\
import { PLASTIC, WALL, bounce, collide, model_form, solid_sphere } from "./balls.mjs";
const up = [0, 0, 1], down = [1, 0, -1], zero = [0, 0, 0], ball = solid_sphere(0.1, 1);
const pair = { friction: 0.3, stiffness_ratio: 1.2, restitution: 0.8, loss: PLASTIC };
const law = { friction: 0.3, stiffness_ratio: 1.2, effective_modulus: 1e9 };
const message = (work) => {
    try {
        work();
        return "none";
    } catch (error) {
        return error instanceof RangeError ? error.message : String(error);
    }
};
console.log(message(() => bounce({ ...pair, restitution: 0 }, up, ball, down, zero)));
for (const one of [MISTAKES]) {
    const all = one.length > 5 ? one : [...one, ...Array(5 - one.length), WALL, zero, zero];
    const said = new Set([message(() => collide(...all)), message(() => model_form(...all))]);
    if (one.length < 6) said.add(message(() => bounce(...one)));
    console.log(...said);
}
"""


def named(columns, rows):
    """Columns by name; vectors have shape (n, 3)."""
    ends = np.cumsum(list(columns.values()))
    parts = np.split(rows, ends[:-1], axis=1)
    return {name: p if p.shape[1] > 1 else p[:, 0] for name, p in zip(columns, parts, strict=True)}


def dot(a, b):
    return np.sum(a * b, axis=1)


def random_impacts(random):
    """Impacts of all kinds; `kind` says which."""
    n, kind = COUNT, np.arange(COUNT) % 20
    # Bodies: spheres and shells of a thousandth to a tenth of a metre.
    given = {}
    for who in ("", "other_"):
        radius = 10 ** random.uniform(-3, -1, n)
        mass = radius**3 * random.uniform(1000, 30000, n)
        given |= {who + "radius": radius, who + "mass": mass}
        given[who + "gyration"] = radius * np.sqrt(random.choice([0.4, 2 / 3], n))
        given[who + "spin"] = random.normal(size=(n, 3)) / radius[:, None]
        given[who + "velocity"] = random.normal(size=(n, 3))
    normal = random.normal(size=(n, 3))
    given["normal"] = normal / np.sqrt(dot(normal, normal))[:, None]
    # Three of four come nearer; some slide throughout, some stick.
    given["velocity"] -= 2 * given["normal"] * random.choice([1.0, 1.0, 1.0, 0.0], n)[:, None]
    given["friction"] = random.uniform(0.05, 1.5, n)
    given["stiffness_ratio"] = random.uniform(1, 1.5, n)
    given["effective_modulus"] = 10 ** random.uniform(6, 11, n)
    given["restitution"] = random.uniform(0.3, 1, n)
    given["loss"] = random.choice([1.0, 2.0], n)
    for name in ("relaxation_time", "yield_pressure"):
        given[name] = np.zeros(n)
    given["restitution"][kind == 3] = 1.0
    given["loss"][kind == 3] = 0.0
    given["friction"][np.isin(kind, (4, 5))] = 0.0
    given["friction"][kind == 9] *= random.random(n)[kind == 9] < 0.5  # those are head-on
    given["friction"][kind == 11] = 10 ** random.uniform(1, 308, n)[kind == 11]
    given["restitution"][kind == 5] = 1.0
    given["restitution"][kind == 6] = random.uniform(0, 0.3, n)[kind == 6]
    viscous, plastic = kind == 7, kind == 8
    # e from 1 to 0.2 at 2 m/s or so.
    m2 = given["mass"] * given["other_mass"] / (given["mass"] + given["other_mass"])
    radius = 1 / (1 / given["radius"] + 1 / given["other_radius"])
    stiff, share = given["effective_modulus"], random.uniform(0.01, 1.05, n)
    time = (m2 / stiff) ** 0.4 / (radius * 2) ** 0.2
    given["relaxation_time"][viscous] = (share * time)[viscous]
    strain = (share + 0.1) * (m2 * 2**2 / stiff / radius**3) ** 0.2
    given["yield_pressure"][plastic] = (2 / np.pi * strain * stiff)[plastic]
    given["restitution"][viscous | plastic] = given["loss"][viscous | plastic] = 0.0
    wall = np.isin(kind, (0, 1, 2))
    for name, value in (("mass", np.inf), ("gyration", np.inf), ("radius", 0.0)):
        given["other_" + name][wall] = value
    head_on, still = kind == 9, kind == 10
    for who in ("", "other_"):
        given[who + "spin"][head_on] = given[who + "velocity"][head_on, :2] = 0.0
    given["normal"][head_on] = [0.0, 0.0, 1.0]
    for name in ("velocity", "spin"):  # v2 = 0 exactly
        given[name][still] = given["other_" + name][still] = 0.0
    return given, kind


def nearly_unit(normal):
    """Vectors whose length differs from 1 by up to 1e-6."""
    return normal * (1 + 0.999e-6 * np.sin(np.arange(len(normal))))[:, None]


def stacked(group):
    """Rows of all columns in their order; normals have any length that is accepted."""
    group = group | {"normal": nearly_unit(group["normal"])}
    return np.column_stack([group[name] for name in COLUMNS])


def refused():
    """`GOOD` with each change of `ACCEPTED` and `REFUSED`."""
    rows = []
    for change in (*ACCEPTED, *REFUSED):
        values = dict.fromkeys(COLUMNS, 0.0) | GOOD | change
        rows.append(np.concatenate([np.broadcast_to(values[k], n) for k, n in COLUMNS.items()]))
    return rows


@pytest.fixture(scope="module")
def given():
    return random_impacts(np.random.default_rng(37))


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("collide")


@pytest.fixture(scope="module")
def found(given, folder):
    """Answers of C, also to `refused`; JavaScript has the same bits."""
    if not (shutil.which("cc") and shutil.which("node")):
        pytest.skip("cc or node is not installed")
    np.concatenate([stacked(given[0]), refused()]).tofile(folder / "impacts")
    export.write_spheres(folder / "balls.h", "c")
    export.write_spheres(folder / "balls.mjs", "js")
    for file, code in (("run.c", C), ("run.mjs", JAVASCRIPT)):
        (folder / file).write_text(code.replace("WIDTH", str(WIDTH)))
    flags = "-std=c99 -O2 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror run.c -o run -lm"
    for command in (["cc", *flags.split()], ["./run"], ["node", "run.mjs"]):
        subprocess.run(command, cwd=folder, check=True)
    (folder / "calls.mjs").write_text(CALLS.replace("MISTAKES", ", ".join(MISTAKES)))
    c, js = (np.fromfile(folder / name).reshape(-1, sum(FIELDS.values())) for name in ("c", "js"))
    np.testing.assert_array_equal(c, js)
    return [named(FIELDS, rows) for rows in np.split(c, [COUNT])]


@pytest.fixture(scope="module")
def contact(given, found):
    """What the contact point does, before and after, as the words say it."""
    before, after = given[0], found[0]
    n = before["normal"]

    def relative(state):
        spins = [before[w + "radius"][:, None] * state[w + "spin"] for w in ("", "other_")]
        return state["velocity"] - state["other_velocity"] - np.cross(spins[0] + spins[1], n)

    return relative(before), relative(after)


def test_momentum_angular_momentum_and_energy(given, found, contact):
    (every, kind), regimes = given, found[0]["regime"]
    assert np.bincount(regimes.astype(int), minlength=8)[[0, 2, 3, 4, 6, 7]].min() > 500
    finite = np.isfinite(every["other_mass"])
    before, after = ({k: v[finite] for k, v in state.items()} for state in (every, found[0]))
    totals = []
    for state in (before, after):
        linear, angular, energy = np.zeros_like(before["normal"]), 0, 0
        for who, sign in (("", 1), ("other_", -1)):
            mass = before[who + "mass"][:, None]
            inertia = mass * before[who + "gyration"][:, None] ** 2
            arm = sign * before[who + "radius"][:, None] * before["normal"]
            v, w = state[who + "velocity"], state[who + "spin"]
            linear = linear + mass * v
            angular = angular + np.cross(arm, mass * v) + inertia * w
            energy = energy + dot(mass * v, v) / 2 + dot(inertia * w, w) / 2
        totals.append((linear, angular, energy))
    mass, length = (before[n] + before["other_" + n] for n in ("mass", "radius"))
    speed = 5 + np.abs(after["velocity"]).max(axis=1) + np.abs(after["other_velocity"]).max(axis=1)
    for part, scale in enumerate((mass * speed, mass * speed * length)):
        assert (np.abs(totals[0][part] - totals[1][part]).max(axis=1) < 1e-14 * scale).all()
    had, has = totals[0][2], totals[1][2]
    assert (has <= had * (1 + 1e-14)).all()
    conserved = (kind == 5)[finite]  # e = 1 without friction
    np.testing.assert_allclose(has[conserved], had[conserved], rtol=1e-14)
    # Walls, which may move, take no energy in their own frame: the impulse works against motion.
    impulse = found[0]["impulse"][~finite]
    work = dot(impulse, (contact[0] + contact[1])[~finite])
    assert (work <= 1e-14 * np.abs(dot(impulse, contact[0][~finite]))).all()
    for name in ("other_velocity", "other_spin"):
        np.testing.assert_array_equal(found[0][name][~finite], every[name][~finite])


def test_impulses_keep_coulombs_limit_and_bodies_leave_by_restitution(given, found, contact):
    (before, kind), after = given, found[0]
    n, hit = before["normal"], after["regime"] != Regime.NO_IMPACT
    along = dot(after["impulse"], n)
    sideways = after["impulse"] - along[:, None] * n
    size = np.sqrt(dot(sideways, sideways))
    assert (size[hit] <= (before["friction"] * along * (1 + 1e-12) + 1e-14 * along)[hit]).all()
    before_v2, after_v2 = -dot(contact[0], n), dot(contact[1], n)
    scale = 1 + np.abs(contact[0]).max(axis=1) + np.abs(contact[1]).max(axis=1)
    gap = np.abs(after_v2 - after["restitution"] * before_v2)
    assert (gap[hit] < 1e-12 * scale[hit]).all()
    assert (before_v2[~hit] <= 1e-15).all() and (before_v2[hit] > 0).all()
    smooth = (kind == 4) | (kind == 5)
    for name in ("spin", "other_spin"):
        np.testing.assert_array_equal(after[name][smooth], before[name][smooth])


def test_bodies_that_separate_or_move_alike_stay_as_they_are(given, found):
    (before, kind), after = given, found[0]
    apart = after["regime"] == Regime.NO_IMPACT
    assert apart[kind == 10].all()
    for name in ("velocity", "spin", "other_velocity", "other_spin"):
        np.testing.assert_array_equal(after[name][apart], before[name][apart])
    assert not after["impulse"][apart].any()
    for name in ("incidence", "restitution", "error_bound", "model_form"):
        assert np.isnan(after[name][apart]).all()
    head_on = (kind == 9) & ~apart
    assert (after["regime"][head_on] == Regime.STICK).all()
    assert not after["incidence"][head_on].any() and not after["spin"][head_on].any()


def test_python_has_the_same_collisions(given, found):
    """Where the table answers: the files may not solve, and below e = 0.3 Python does."""
    rows = found[0]["regime"] != Regime.UNRESOLVED
    before, after = ({k: v[rows] for k, v in state.items()} for state in (given[0], found[0]))
    fixed = (before["relaxation_time"] == 0) & (before["yield_pressure"] == 0)
    laws = {name: np.where(before[name] > 0, before[name], np.nan) for name in LAWS}
    laws["restitution"] = np.where(fixed, before["restitution"], np.nan)
    pair = collision.Pair(
        **{name: before[name] for name in ("friction", "stiffness_ratio", "effective_modulus")},
        **laws,
        loss=np.array(["", *spheres.LOSSES])[before["loss"].astype(int)],
    )
    states = {name: before[name] for name in before if name.endswith(("velocity", "spin"))}
    body, other = (Body(*(before[w + name] for name in BODY.split())) for w in ("", "other_"))
    wanted = collision.collide(pair, nearly_unit(before["normal"]), body, other=other, **states)
    for name in ("velocity", "other_velocity", "spin", "other_spin", "restitution", "incidence"):
        np.testing.assert_allclose(after[name], getattr(wanted, name), rtol=1e-7, atol=1e-7)
    np.testing.assert_array_equal(after["regime"], wanted.regime)
    assert not (after["error_bound"] < wanted.error_bound * (1 - 1e-6)).any()
    known = ~np.isnan(after["model_form"])
    np.testing.assert_allclose(after["model_form"][known], wanted.model_form[known], atol=1e-7)
    assert (after["restitution"][~known & np.isfinite(wanted.model_form)] < 0.3).all()


def test_bad_numbers_and_what_the_table_lacks_have_no_answer(found):
    at = len(ACCEPTED)
    for name, values in found[1].items():
        if name == "regime":
            assert (values[:at] == Regime.STICK_SLIP).all()
            assert (values[at:] == Regime.UNRESOLVED).all()
        elif name == "told":
            assert not values[:at].any() and values[at:].all()
        else:
            assert np.isfinite(values[:at]).all() and np.isnan(values[at:]).all(), name


def shifted(rows, decades):
    """Rows with each number so many decades larger, or smaller, within the range of numbers."""
    root, most = 10 ** (decades / 2), np.finfo(float).max
    with np.errstate(over="ignore"):
        return np.where(np.isinf(rows), rows, np.clip(rows * root * root, -most, most))


def told(rows, folder):
    """Whether C tells a problem, and whether a number of its answer is missing without one."""
    rows.tofile(folder / "impacts")
    subprocess.run([folder.parent / "run"], cwd=folder, check=True)
    c = np.fromfile(folder / "c").reshape(len(rows), -1)
    after = named(FIELDS, c)
    finite = np.isfinite(c[:, :15]).all(axis=1) & ~np.isnan(after["incidence"])
    low = after["restitution"] < spheres.LEAST_RESTITUTION
    for name in ("restitution", "error_bound", "model_form"):
        finite &= np.isfinite(after[name]) | (low & (name != "restitution"))
    quiet = after["told"] == 0
    still = after["regime"] == Regime.NO_IMPACT
    np.testing.assert_array_equal(c[quiet & still, :12], rows[quiet & still][:, STATES])
    return ~quiet, quiet & ~still & ~finite


def test_a_problem_is_told_wherever_a_number_would_not_be_finite(given, found, folder):
    """Numbers of all kinds up to 310 decades away, and as near to a problem as they can be."""
    folder, random = folder / "extremes", np.random.default_rng(49)
    folder.mkdir()
    rows = stacked({name: values[: COUNT // 5] for name, values in given[0].items()})
    decades = []
    for name, width in COLUMNS.items():
        scale = random.uniform(-310, 310, (len(rows), width + 1))
        scale *= random.random(scale.shape) < ([0.05] * width + [0.3])
        fixed = name in ("normal", "stiffness_ratio", "restitution", "loss")
        decades.append(np.clip(scale[:, :-1] + scale[:, -1:], -310, 310) * (not fixed))
    of = dict(zip(COLUMNS, decades, strict=True))
    for who in ("", "other_"):  # else most mass ratios are beyond the table
        of[who + "gyration"][:] = of[who + "radius"]
    decades = np.concatenate(decades, axis=1)
    refused_from, missing = told(shifted(rows, decades), folder)
    assert not missing.any() and COUNT // 50 < refused_from.sum() < COUNT // 6
    subprocess.run(["node", "../run.mjs"], cwd=folder, check=True)
    np.testing.assert_array_equal(*(np.fromfile(folder / name) for name in ("c", "js")))
    rows, decades = rows[refused_from], decades[refused_from]
    good, bad = np.zeros((2, len(rows), 1))
    bad[:] = 1
    for _ in range(50):
        middle = (good + bad) / 2
        is_told, missing = told(shifted(rows, middle * decades), folder)
        assert not missing.any()
        good[~is_told], bad[is_told] = middle[~is_told], middle[is_told]


def test_c_and_javascript_say_what_is_wrong(found, folder):
    c, js = ((folder / f"{language}.txt").read_text().splitlines() for language in ("c", "js"))
    assert len(c) == len(REFUSED)
    assert [re.sub(r" = .*?(?=: allowed)", "", text) for text in js] == [
        text.replace("BALLS_", "").replace("a vector of three", "an array of three") for text in c
    ]
    fields = [re.sub(r"^(pair|body)\.", "", text.split(":")[0]).replace(".", "_") for text in c]
    changed = [next(iter(change)) for change in REFUSED]
    assert {(one, field) for one, field in zip(changed, fields, strict=True) if one != field} == {
        ("yield_pressure", "pair"),
        ("gyration", "mass_ratio/stiffness_ratio"),
        ("restitution", "relaxation_time"),
    }
    command = ["node", "calls.mjs"]
    done = subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True)
    said = done.stdout.splitlines()
    assert said[0] == "none"  # restitution may be 0
    for text, (call, begin) in zip(said[1:], MISTAKES.items(), strict=True):
        assert text.startswith(begin) and text.count("allowed") == 1, (call, text)


def test_below_the_table_the_contact_keeps_its_limits_and_says_so(given, found):
    rows = (given[1] == 6) & (found[0]["regime"] == Regime.UNRESOLVED)
    for name in ("velocity", "spin", "impulse", "restitution"):
        assert np.isfinite(found[0][name][rows]).all()
    for name in ("error_bound", "model_form"):
        assert np.isnan(found[0][name][rows]).all()
