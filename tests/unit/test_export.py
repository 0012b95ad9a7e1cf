"""Spheres in C and JavaScript: the answers of Python, and what is refused."""

import re
import shlex
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from planarimpact import InputError, Regime, bodies, collision, export, spheres
from planarimpact.__main__ import main
from planarimpact.bodies import Body, Material, stiffness_ratio
from planarimpact.spheres import table
from tests import programs
from tests.package_tables import spheres_tables
from tests.property import test_collide

PROGRAMS = Path(__file__).parent / "export"
README = Path(__file__).parents[2] / "src/README.md"
COUNT = 20_000
ACCURACY = 1e-14  # of the largest value
LARGEST = 1e100  # incidence
EDGES = 30  # of each kind in each patch
# Of the table of spheres: values for x, mass ratio, stiffness ratio, restitution and loss.
BEYOND = [
    (np.nan, np.nan, np.nan, np.nan, 3.0),
    (np.inf, 0.9, 0.0, 0.299, 0.0),
    (np.nextafter(LARGEST, np.inf), np.inf, 3.6, 1.0000001, 7.0),
    (-np.inf, 1.2, -1.21, -0.5, 100.0),
]
STATE = "velocity", "peak_friction", "dissipation", "regime"
FIELDS = {"velocity": 3, "spin": 3, "other_velocity": 3, "other_spin": 3, "impulse": 3}
FIELDS |= {"incidence": 1, "restitution": 1, "error_bound": 1, "regime": 1, "model_form": 1}
FIELDS["told"] = 1  # whether a problem is
PAIR = "friction stiffness_ratio restitution relaxation_time yield_pressure effective_modulus loss"
BODY = "mass gyration radius"
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
    *({name: np.nan} for name in (*GOOD, "spin", "other_velocity", "other_spin", "other_radius")),
    *({name: -1.0} for name in ("friction", "radius", "mass", "gyration", "restitution")),
    *({"normal": (0.0, 0.0, 1.01)}, {"velocity": (np.inf, 0.0, -1.0)}, {"mass": np.inf}),
    *({"restitution": 1.1}, {"loss": 0.0}, {"loss": 3.0}, {"yield_pressure": 1e9}),
    *({"stiffness_ratio": 3.6}, {"gyration": 0.1}),  # beyond the table
    {"restitution": 0.0, "loss": 0.0, "relaxation_time": 1.0, "effective_modulus": 1e9},
    *({"loss": code, "restitution": 1.0} for code in (3.0, -1.0)),
    # The same where nothing approaches.
    *({"normal": (0.0, 0.0, length)} | AWAY for length in (0.0, -2.0, 0.9999985, 1.0000015)),
    *({"loss": 3.0} | AWAY, {"friction": -1.0} | AWAY, {"restitution": 1.1} | AWAY),
    # Too large, or too small, to compute with.
    *({"velocity": (0.1, 0.0, -2.0), "mass": mass} for mass in (5e307, 5e-324)),
    {"velocity": (0.1, 0.0, -0.9), "mass": 1.5e308},
]
FLAGS = ["-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Wdouble-promotion"]
FLAGS += ["-Werror"]
COMPILERS = {"c": ("spheres in C", "-std=c99"), "cpp": ("spheres in C++", "-xc++")}
# What a caller of JavaScript forgets or mistakes, and how the message begins.
MISTAKES = {
    "[{ ...pair, loss: undefined }, up, ball, down, zero]": "pair.loss = undefined: ",
    "[{ ...law, yield_pressure: '1e9' }, up, ball, down, zero]": "pair.yield_pressure = ",
    "[pair, up, { ...ball, mass: '1' }, down, zero]": 'body.mass = "1": ',
    "[{ friction: 1, stiffness_ratio: 1.5 }, up, ball, down, zero]": "pair = { friction: 1, ",
    "[undefined, up, ball, down, zero]": "pair = undefined: allowed is an object",
    "[pair, { x: 0, y: 0, z: 1 }, ball, down, zero]": "normal = { x: 0, y: 0, z: 1 }: allowed is ",
    "[pair, up, ball, [0, 0, -1, 0], zero]": "velocity = [0, 0, -1, 0]: ",
    "[pair, up, ball, down]": "spin = undefined: allowed is an array of three ",
    "[pair, up, { mass: 1, radius: 1 }, down, zero]": "body.gyration = undefined: ",
    "[pair, up, ball, down, zero, null, zero, zero]": "other = null: allowed is an object",
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Files of both tables in both languages, and the programs that call them."""
    folder = tmp_path_factory.mktemp("export")
    for tolerance, name in export.TABLES.items():
        export.write_spheres(folder / f"{name}.h", "c", tolerance)
        export.write_spheres(folder / f"{name}.mjs", "js", tolerance)
        for program in ("run.c", "run.mjs"):
            text = (PROGRAMS / program).read_text(encoding="utf-8")
            text = text.replace("TABLE", name).replace("WIDTH", str(WIDTH))
            (folder / program.replace(".", f"_{name}.")).write_text(text)
    return folder


def run(folder, language, name, job, rows):
    """Answers to rows of impacts, and messages; what is not compiled yet is compiled first."""
    command = [programs.needed("spheres in JavaScript"), f"run_{name}.mjs"]
    if language != "js":
        command = [f"./{language}_{name}"]
        if not (folder / command[0]).exists():
            compiler = [*COMPILERS[language], *FLAGS, "-O2", f"run_{name}.c", "-o", command[0]]
            compiler[0] = programs.needed(compiler[0])
            done = subprocess.run([*compiler, "-lm"], cwd=folder, capture_output=True, text=True)
            assert done.returncode == 0, done.stderr
    rows.tofile(folder / "in")
    done = subprocess.run([*command, job], cwd=folder, check=True, capture_output=True, text=True)
    return np.fromfile(folder / "out").reshape(len(rows), -1), done.stdout.splitlines()


def said_by_node(folder, name, text):
    """Lines that a program in JavaScript prints."""
    (folder / name).write_text(text)
    command = [programs.needed("spheres in JavaScript"), name]
    done = subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True)
    return done.stdout.splitlines()


# Impacts by their groups ----------------------------------------------------------------------


def sphere_edges(shipped, random):
    """Ends of patches, and faces of splines."""
    for name, panel in shipped.panels.items():
        sizes = [size - table.ORDER + 1 for size in panel.velocity.shape[1:]]
        for number, intervals in enumerate(panel.intervals):
            shape = np.array([intervals, *sizes])[:, None]
            s, t, u = random.integers(0, 1 + shape, (3, EDGES)) / shape
            y, b, e = spheres_tables.impacts(name, panel.edges, shipped.limits, number, s, t, u)
            varying = table.varying_edges(panel.edges, t, u)
            loss = np.full(EDGES, 1.0 + (name != "viscous"))
            for x in np.broadcast_arrays(y, *table.edges_of(name, varying, b, e)[1:]):
                yield np.stack([x, b, np.ones(EDGES), e, loss])


def impacts_of(shipped):
    """Edges, bounds, what is refused, and random impacts."""
    random = np.random.default_rng(20)
    loss = np.arange(COUNT) % 2
    least = np.array([0.1, 0.3])[loss]
    e, ratio = random.uniform(least, 1), random.uniform(1.1, 3.5, COUNT)
    e[::9], e[1::9], ratio[2::9], ratio[3::9] = least[::9], 1.0, 1.1, 3.5
    for start, limit in zip((4, 13), table.limits_at(shipped, ratio), strict=True):
        e[start::18] = np.maximum(limit, least)[start::18]
    beta = random.choice([2.5, 3.5], COUNT)
    x = random.uniform(-1.1, 1.1, COUNT) * (1 + e) * beta
    x[5::99], x[6::99], x[7::99], x[8::99] = 0.0, 5e-324, LARGEST, np.inf
    groups = [np.stack([x, beta, beta / ratio, e, 1.0 + loss])]
    groups += sphere_edges(shipped, random)
    refused = np.tile([[2.0], [3.5], [1.21], [0.8], [2.0]], 5 * len(BEYOND))
    for i, value in enumerate(BEYOND):
        refused[range(5), range(5 * i, 5 * i + 5)] = value
    return np.concatenate([*groups, refused], axis=1)


def of_python(impacts, shipped, monkeypatch):
    """Python's five answers, and which impacts do not slide throughout."""
    x, beta, zeta2, e, loss = impacts
    with np.errstate(all="ignore"):
        good = (np.abs(x) <= LARGEST) & (beta >= 1) & ((loss == 1) | (loss == 2))
        groups = beta, zeta2, e
        own = (spheres.covers(*groups, loss=name) for name in ("viscous", "plastic"))
        good &= np.where(loss == 1, *own)
        tabled = good & (np.abs(x) < np.maximum(zeta2, beta + e * (beta - zeta2)))
    words = np.array(["", *spheres.LOSSES])[loss[good].astype(int)]
    monkeypatch.setattr(table, "shipped", lambda: shipped)
    found = spheres.rebound(x[good], beta[good], zeta2[good], e[good], loss=words)
    wanted = np.full((5, good.size), np.nan)
    wanted[4] = Regime.UNRESOLVED
    wanted[:, good] = np.stack([found.velocity, *(getattr(found, name) for name in STATE)])
    return wanted, tabled


@pytest.mark.parametrize(
    ("language", "name"),
    [
        *(("c", "coarse"), ("js", "coarse"), ("js", "fine")),
        pytest.param("c", "fine", marks=pytest.mark.long),  # long to compile
        pytest.param("cpp", "fine", marks=pytest.mark.long),
    ],
)
def test_other_languages_answer_as_python_does(language, name, folder, monkeypatch):
    """To 1e-14; a value beyond the table, which may be of any size, has a bound of its own."""
    shipped = table.shipped(name)
    impacts = impacts_of(shipped)
    found = run(folder, language, name, "rebound", np.ascontiguousarray(impacts.T))[0].T
    wanted, tabled = of_python(impacts, shipped, monkeypatch)
    nan = np.isnan(wanted)
    size = np.where(nan, 0.0, np.abs(wanted))
    bound = ACCURACY * np.maximum(size, size[:, tabled].max(axis=1, keepdims=True))
    same = (np.abs(found - wanted) <= bound) | (np.isnan(found) & nan)
    same &= (impacts[0] != 0) | nan | (np.signbit(found) == np.signbit(wanted))
    assert same.all(axis=1).tolist() == [True] * 5


@pytest.mark.parametrize("name", export.TABLES.values())
def test_files_name_their_range_and_errors(name, folder):
    constants = {"INCIDENCE_MAX": LARGEST, "VISCOUS": 1, "PLASTIC": 2}
    constants |= {"RESTITUTION_MIN_VISCOUS": 0.1, "RESTITUTION_MIN_PLASTIC": 0.3}
    constants |= {"RATIO_MIN": 1.1, "RATIO_MAX": 3.5}
    constants |= {"STIFFNESS_MAX": 3.5, "STIFFNESS_STATED": 1.6}
    constants |= {f"ERROR_{loss.upper()}": x for loss, x in export.BOUNDS[name].items()}
    header, module = ((folder / f"{name}.{ending}").read_text() for ending in ("h", "mjs"))
    words = r"zeta\^2, normal over tangential stiffness: (\(.*?\)\)) for"
    formula = re.search(words, header)[1].replace("2 (", "2 * (")
    assert eval(formula, {"nu": 0.3}) == stiffness_ratio(Material(1.0, 0.3))
    for constant, value in constants.items():
        assert f"#define {name.upper()}_{constant} {value}\n" in header
        assert f"export const {constant} = {value};\n" in module


def test_a_header_meets_cpp_and_never_a_compiler_without_nan(folder):
    """A compiler without NaN may drop the test of the range, and a table is read beyond its end."""
    for what, standard in COMPILERS.values():
        for option, works in (("-Werror", True), ("-ffast-math", False)):
            command = [
                programs.needed(what),
                standard,
                *FLAGS,
                option,
                "-fsyntax-only",
                "run_coarse.c",
            ]
            done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
            assert (done.returncode == 0) == works, done.stderr
            assert works or "This header needs NaN" in done.stderr


def test_bodies_have_the_numbers_of_python(folder):
    """A density and a mass are told apart by the name, in every language."""
    shapes = {
        "solid_sphere_by_density": bodies.solid_sphere(0.0127, density=7800),
        "solid_sphere_by_mass": bodies.solid_sphere(0.0127, mass=7800),
        "thin_shell": bodies.thin_shell(0.0127, mass=7800),
    }
    calls = "".join(f"    show(coarse_{shape}(0.0127, 7800));\n" for shape in shapes)
    (folder / "bodies.c").write_text(
        '#include <stdio.h>\n#include "coarse.h"\nstatic void show(struct coarse_body b)\n{\n'
        '    printf("%.17g %.17g %.17g\\n", b.mass, b.gyration, b.radius);\n}\n'
        f"int main(void)\n{{\n{calls}    return 0;\n}}\n"
    )
    compiler = [programs.needed("spheres in C"), "-std=c99", "bodies.c", "-o", "bodies", "-lm"]
    subprocess.run(compiler, cwd=folder, check=True)
    done = subprocess.run(["./bodies"], cwd=folder, check=True, capture_output=True, text=True)
    text = 'import * as coarse from "./coarse.mjs";\nconst show = ({ mass, gyration, radius }) =>\n'
    text += "    console.log(mass, gyration, radius);\n" + calls.replace("coarse_", "coarse.")
    wanted = np.array(list(shapes.values()), float)
    for lines in (done.stdout.splitlines(), said_by_node(folder, "bodies.mjs", text)):
        np.testing.assert_array_equal(np.array([line.split() for line in lines], float), wanted)


# Types for TypeScript -------------------------------------------------------------------------


def test_every_export_has_its_type(folder):
    for name in export.TABLES.values():
        module, types = ((folder / f"{name}{end}").read_text() for end in (".mjs", ".d.mts"))
        signature = r"export (function \w+\([^)]*\)|const \w+)"
        written, declared = (re.findall(signature, text) for text in (module, types))
        # The arguments without their types, and without a comma after the last one.
        plain = [re.sub(r": [^,)]+|,?\s+(?=\))", "", one) for one in declared]
        found, wanted = (
            sorted(re.sub(r"\s+", "", one) for one in several) for several in (plain, written)
        )
        assert found == wanted and len(found) > 25


def test_types_pass_and_refuse_what_they_should(folder):
    """Lines of client.mts below `@ts-expect-error` must be refused, all others must pass."""
    tsc = programs.needed("types for TypeScript")
    shutil.copy(PROGRAMS / "client.mts", folder)
    command = [tsc, "--strict", "--noEmit", "--module", "nodenext", "client.mts"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout


def test_neither_the_code_nor_its_types_appear_alone(tmp_path):
    (tmp_path / "ball.d.ts").mkdir()
    with pytest.raises(InputError, match="ball.d.ts: it is there already, and no regular file"):
        export.write_spheres(tmp_path / "ball.js", "js", tolerance=max(export.TABLES))
    assert [path.name for path in tmp_path.iterdir()] == ["ball.d.ts"]


# The README's examples ------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("language", "file", "what", "options"),
    [
        ("c", "main.c", "spheres in C", "-std=c99 -O2 main.c -lm"),
        ("js", "main.mjs", "spheres in JavaScript", "main.mjs"),
    ],
)
def test_the_readme_prints_what_it_says(language, file, what, options, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    section = README.read_text(encoding="utf-8").split("## In C and JavaScript")[1]
    written = re.findall(rf"^\S+/planarimpact (.* --as {language} .*)$", section, flags=re.M)
    assert [main(shlex.split(command)) for command in written] == [0] * len(written)
    blocks = re.findall(rf"```{language}\n(.*?)```", section, flags=re.S)
    assert len(written) == len(blocks) == 1
    (tmp_path / file).write_text(blocks[0])
    command = [programs.needed(what), *options.split()]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    if language == "c":
        done = subprocess.run(["./a.out"], check=True, capture_output=True, text=True)
    said = re.findall(r"^ *(?:printf|console.log)\(.*; // (.*)$", blocks[0], flags=re.M)
    assert said and done.stdout.splitlines() == said


def test_the_time_step_of_the_loop_for_games_does_not_change_how_the_ball_bounces(folder):
    blocks = re.findall(r"```js\n(.*?)```", README.read_text(encoding="utf-8"), flags=re.S)
    (loop,) = (block.replace("spheres.mjs", "coarse.mjs") for block in blocks if "slow = " in block)
    assert "1 / 60;" in loop and "k < 600;" in loop
    loops = (loop.replace("1 / 60", f"1 / {n}").replace("600", f"{10 * n}") for n in (30, 60, 240))
    assert len({said_by_node(folder, "loop.mjs", text)[0] for text in loops}) == 1


# Collisions -----------------------------------------------------------------------------------


def named(columns, rows):
    """Columns by name; vectors have shape (n, 3)."""
    ends = np.cumsum(list(columns.values()))
    parts = np.split(rows, ends[:-1], axis=1)
    return {name: p if p.shape[1] > 1 else p[:, 0] for name, p in zip(columns, parts, strict=True)}


def random_impacts():
    """Those of test_collide as Python takes them, with more friction and less restitution too."""
    pair, *others = test_collide.random_impacts(COUNT, seed=37)
    random, rare = np.random.default_rng(37), np.arange(COUNT) % 20 == 0
    said = {name: getattr(pair, name) for name in PAIR.split()[:-1]}
    said["friction"] = np.where(rare, 10 ** random.uniform(1, 100, COUNT), pair.friction)
    less = rare & ~np.isnan(pair.restitution)
    said["restitution"] = np.where(less, random.uniform(0, 0.3, COUNT), pair.restitution)
    # By a law, e is from 1 to 0.2 at 2 m/s or so.
    _, body, velocity, spin, other, _, other_spin = others
    m2, radius = 1 / (1 / body.mass + 1 / other.mass), body.radius
    stiff, share = pair.effective_modulus, random.uniform(0.01, 1.05, COUNT)
    time = share * (m2 / stiff) ** 0.4 / radius**0.2
    pressure = 2 / np.pi * stiff * (share + 0.1) * (m2 * 2**2 / stiff / radius**3) ** 0.2
    said["relaxation_time"] = np.where(np.isnan(pair.relaxation_time), np.nan, time)
    said["yield_pressure"] = np.where(np.isnan(pair.yield_pressure), np.nan, pressure)
    touch = ~velocity.any(axis=1)  # else rounding would say whether they approach
    spin[touch] = other_spin[touch] = 0.0
    return collision.Pair(**said, loss=pair.loss), *others


def rows_of(pair, normal, body, velocity, spin, other, other_velocity, other_spin):
    """The same with all columns in a row; loss is said where there is one by a constant e."""
    given = {name: np.nan_to_num(getattr(pair, name)) for name in PAIR.split()[:-1]}
    constant = (given["restitution"] < 1) & ~np.isnan(pair.restitution)
    given |= {"loss": np.where(constant, 1.0 + (pair.loss == "plastic"), 0.0), "normal": normal}
    for who, one in (("", body), ("other_", other)):
        given |= {who + name: getattr(one, name) for name in BODY.split()}
    given |= {"velocity": velocity, "spin": spin}
    given |= {"other_velocity": other_velocity, "other_spin": other_spin}
    return np.column_stack([given[name] for name in COLUMNS])


def chosen(impacts, rows):
    """Some of them."""
    return [
        Body(*(part[rows] for part in one)) if isinstance(one, Body) else one[rows]
        for one in impacts
    ]


@pytest.fixture(scope="module")
def collisions(folder):
    """Impacts as Python takes them, and what they become with the fine table.

    C has the bits of JavaScript. Lengths of normals differ from 1 by up to 1e-6.
    """
    pair, normal, *others = random_impacts()
    normal = normal * (1 + 0.999e-6 * np.sin(np.arange(COUNT)))[:, None]
    rows = rows_of(pair, normal, *others)
    c, js = (run(folder, language, "coarse", "collide", rows)[0] for language in ("c", "js"))
    np.testing.assert_array_equal(c, js)
    return (pair, normal, *others), named(FIELDS, run(folder, "js", "fine", "collide", rows)[0])


def test_python_has_the_same_collisions(collisions):
    """Where a table answers; Python's own keep the laws of mechanics, see test_collide."""
    impacts, after = collisions
    assert np.bincount(after["regime"].astype(int))[[0, 2, 3, 4, 6, 7]].min() > COUNT // 200
    rows = after["regime"] != Regime.UNRESOLVED
    after = {name: values[rows] for name, values in after.items()}
    wanted = collision.collide(*chosen(impacts, rows))
    for name in ("velocity", "other_velocity", "spin", "other_spin", "restitution", "incidence"):
        np.testing.assert_allclose(after[name], getattr(wanted, name), rtol=1e-7, atol=1e-7)
    mass = impacts[2].mass[rows, None]
    np.testing.assert_allclose(after["impulse"] / mass, wanted.impulse / mass, atol=1e-7)
    np.testing.assert_array_equal(after["regime"], wanted.regime)
    np.testing.assert_array_equal(np.isnan(after["error_bound"]), np.isnan(wanted.error_bound))
    # Plastic impacts have the bound of all panels, in Python that of their own.
    loose = spheres.ERROR_BOUND["plastic"] / spheres.PANEL_BOUND["plastic_high"]
    bound = wanted.error_bound > 0
    ratios = np.unique(after["error_bound"][bound] / wanted.error_bound[bound])
    assert np.abs(ratios[:, None] - [1.0, loose]).min(axis=1).max() < 1e-6 and ratios[0] < 2
    assert not after["error_bound"][wanted.error_bound == 0].any()
    known = ~np.isnan(after["model_form"])
    np.testing.assert_allclose(after["model_form"][known], wanted.model_form[known], atol=1e-7)
    assert (after["restitution"][~known & np.isfinite(wanted.model_form)] < 0.3).all()


def test_below_the_table_the_motion_along_the_surface_is_that_of_its_least_restitution(collisions):
    """Within Coulomb's limit; momentum is kept, and restitution is what it should be."""
    impacts, after = collisions
    rows = after["regime"] == Regime.UNRESOLVED
    pair, normal, *others = impacts = chosen(impacts, rows)
    after = {name: values[rows] for name, values in after.items()}
    assert np.isnan([after["error_bound"], after["model_form"]]).all()
    said = {name: getattr(pair, name) for name in ("friction", "stiffness_ratio")}
    least = np.where(pair.loss == "plastic", 0.3, 0.1)
    slow = collision.Pair(**said, restitution=least, loss=pair.loss)
    tabled = collision.collide(slow, normal, *others)
    e, unit = after["restitution"], normal / np.linalg.norm(normal, axis=1)[:, None]
    constant = ~np.isnan(pair.restitution)
    np.testing.assert_array_equal(e[constant], pair.restitution[constant])
    push = test_collide.dot(tabled.impulse, unit)
    drag = tabled.impulse - push[:, None] * unit
    size, push = np.linalg.norm(drag, axis=1), push * (1 + e) / (1 + least)
    share = np.minimum(size, pair.friction * push) / np.where(size > 0, size, 1.0)
    wanted = push[:, None] * unit + share[:, None] * drag
    mass, moment = test_collide.inertia(others[0])
    for found in (after["impulse"], mass[:, None] * (after["velocity"] - others[1])):
        np.testing.assert_allclose(found / mass[:, None], wanted / mass[:, None], atol=1e-7)
    turned = -others[0].radius[:, None] * np.cross(unit, wanted) / moment[:, None]
    np.testing.assert_allclose(after["spin"] - others[2], turned, rtol=1e-7, atol=1e-4)


# What is refused ------------------------------------------------------------------------------


def test_bad_numbers_and_what_the_table_lacks_have_no_answer_but_a_message(folder):
    rows = []
    for change in (*ACCEPTED, *REFUSED):
        values = dict.fromkeys(COLUMNS, 0.0) | GOOD | change
        rows.append(np.concatenate([np.broadcast_to(values[k], n) for k, n in COLUMNS.items()]))
    (found, in_c), (same, in_js) = (
        run(folder, language, "coarse", "collide", np.array(rows)) for language in ("c", "js")
    )
    np.testing.assert_array_equal(found, same)
    found, at = named(FIELDS, found), len(ACCEPTED)
    assert (
        found.pop("regime") == at * [Regime.STICK_SLIP] + len(REFUSED) * [Regime.UNRESOLVED]
    ).all()
    assert (found.pop("told") == at * [0] + len(REFUSED) * [1]).all()
    for name, values in found.items():
        assert np.isfinite(values[:at]).all() and np.isnan(values[at:]).all(), name
    assert [re.sub(r" = .*?(?=: allowed)", "", text) for text in in_js] == [
        text.replace("COARSE_", "").replace("a vector of three", "an array of three")
        for text in in_c
    ]
    fields = [re.sub(r"^(pair|body)\.", "", text.split(":")[0]).replace(".", "_") for text in in_c]
    changed = [next(iter(change)) for change in REFUSED]
    assert {(one, field) for one, field in zip(changed, fields, strict=True) if one != field} == {
        ("yield_pressure", "pair"),
        ("gyration", "mass_ratio/stiffness_ratio"),
        ("restitution", "relaxation_time"),
    }


def test_mistakes_of_callers_of_javascript_are_named(folder):
    calls = (PROGRAMS / "calls.mjs").read_text(encoding="utf-8")
    said = said_by_node(folder, "calls.mjs", calls.replace("MISTAKES", ", ".join(MISTAKES)))
    assert said[0] == "none"  # restitution may be 0
    for text, (call, begin) in zip(said[1:], MISTAKES.items(), strict=True):
        assert text.startswith(begin) and text.count("allowed") == 1, (call, text)


def test_a_problem_is_told_wherever_a_number_would_not_be_finite(folder, collisions):
    """Numbers of all kinds up to 310 decades away."""
    random, rows, most = np.random.default_rng(49), rows_of(*collisions[0]), np.finfo(float).max
    of = {}
    for name, width in COLUMNS.items():
        scale = random.uniform(-310, 310, (COUNT, width + 1))
        scale *= random.random(scale.shape) < ([0.05] * width + [0.3])
        fixed = name in ("normal", "stiffness_ratio", "restitution", "loss")
        of[name] = np.clip(scale[:, :-1] + scale[:, -1:], -310, 310) * (not fixed)
    for who in ("", "other_"):  # else most mass ratios are beyond the table
        of[who + "gyration"] = of[who + "radius"]
    root = 10 ** (np.column_stack(list(of.values())) / 2)
    with np.errstate(over="ignore"):
        rows = np.where(np.isinf(rows), rows, np.clip(rows * root * root, -most, most))
    found, same = (run(folder, language, "coarse", "collide", rows)[0] for language in ("c", "js"))
    np.testing.assert_array_equal(found, same)
    after = named(FIELDS, found)
    finite = np.isfinite(found[:, :15]).all(axis=1) & np.isfinite(after["restitution"])
    finite &= ~np.isnan(after["incidence"])
    plastic = (rows[:, 5] > 0) | (rows[:, 6] == 2)  # the table of the others is wider
    least = np.where(plastic, *map(spheres.LEAST_RESTITUTION.get, ("plastic", "viscous")))
    known = np.isfinite(after["error_bound"]) & (np.isfinite(after["model_form"]) | ~plastic)
    finite &= (after["restitution"] < least) | known
    told, still = after["told"] == 1, after["regime"] == Regime.NO_IMPACT
    np.testing.assert_array_equal(found[still, :12], rows[still][:, STATES])
    assert (told | still | finite).all() and COUNT // 10 < told.sum() < COUNT * 5 // 6
