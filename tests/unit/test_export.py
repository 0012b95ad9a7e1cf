"""The table of spheres computes in C and JavaScript what it does in Python."""

import json
import re
import shlex
import shutil
import subprocess
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from planarimpact import InputError, Regime, export, spheres
from planarimpact.__main__ import main
from planarimpact.spheres import making, table

README = Path(__file__).parents[2] / "src/README.md"
COUNT = 100_000
ACCURACY = 1e-14  # of the largest value
LARGEST = 8e307  # incidence
# Files that are a little wrong: which file is right, what it has, and what stands there instead.
WRONG = {
    "wrong_coarse": ("coarse", "* 3 + 4) / 6", "* 3 + 4) / 6.0000000001"),
}
# Of the table of spheres: values for x, mass ratio, stiffness ratio, restitution and loss.
REFUSED = [
    (np.nan, np.nan, np.nan, np.nan, 2.0),
    (np.inf, 0.9, 0.0, 0.299, -1.0),
    (np.nextafter(LARGEST, np.inf), np.inf, 3.0, 1.0000001, 7.0),
    (-np.inf, 1.8, -1.21, -0.5, 100.0),
]
EDGES = 100  # of each kind in each patch
FIELDS = "velocity", "peak_friction", "dissipation", "regime"
FLAGS = [
    *("-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Wdouble-promotion"),
    *("-Werror", "-O2", "run.c", "-o", "run", "-lm"),
]
# For each file: the constants, then velocity and the fields of rebound for each impact.
C = """\
#include <stdio.h>
#define SPHERES x[0], x[1], x[2], x[3], (int)x[4]
#define RUN(p, ...) \\
    do { \\
        const double constants[] = {__VA_ARGS__}; \\
        double x[5]; \\
        FILE *in = fopen(#p ".x", "rb"), *out = fopen(#p ".out", "wb"); \\
        if (!in || !out) \\
            return 1; \\
        fwrite(constants, sizeof constants, 1, out); \\
        while (fread(x, sizeof x, 1, in) == 1) { \\
            const struct p##_result r = p##_rebound(SPHERES); \\
            const double row[] = {p##_velocity(SPHERES), r.FIELDS}; \\
            fwrite(row, sizeof row, 1, out); \\
        } \\
        fclose(in); \\
        fclose(out); \\
    } while (0)
"""
C = C.replace("r.FIELDS", ", ".join(f"(double)r.{name}" for name in FIELDS))
JAVASCRIPT = """\
import { readFileSync, writeFileSync } from "node:fs";
for (const [name, constants] of Object.entries(CASES)) {
    const module = await import(`./${name}.mjs`), bytes = readFileSync(`${name}.x`);
    const x = new Float64Array(bytes.buffer, bytes.byteOffset, bytes.length / 8);
    const rows = constants.map((name) => module[name]);
    for (let i = 0; i < x.length; i += 5) {
        const one = x.subarray(i, i + 5), state = module.rebound(...one);
        rows.push(module.velocity(...one), ...FIELDS.map((field) => state[field]));
    }
    writeFileSync(`${name}.out`, new Uint8Array(Float64Array.from(rows).buffer));
}
"""


class Case(NamedTuple):
    """A file: constants that it must have, impacts, shape (n, 5), and five answers each."""

    constants: dict[str, float]
    impacts: np.ndarray
    wanted: np.ndarray
    tabled: np.ndarray  # impacts that do not slide throughout: the others may be of any size


def beside(values):
    """Values, and the floats next to them."""
    return np.concatenate([values, np.nextafter(values, 0), np.nextafter(values, np.inf)])


def answers(good, velocity, rebound):
    """Five answers to each impact; where Python refuses, what stands for that."""
    found = np.full((5, good.size), np.nan)
    found[4] = Regime.UNRESOLVED
    found[:, good] = np.stack([velocity, *rebound[:4]])
    return found


def sphere_edges(shipped, random):
    """Ends of patches and faces of splines, in x, ratio and restitution, and one float beside."""
    for name, panel in shipped.panels.items():
        sizes = [size - table.ORDER + 1 for size in panel.velocity.shape[1:]]
        for number, intervals in enumerate(panel.intervals):
            shape = np.array([intervals, *sizes])[:, None]
            s, t, u = random.integers(0, 1 + shape, (3, EDGES)) / shape
            free = random.random((2, EDGES))
            t, u = np.where(random.random((2, EDGES)) < 0.5, free, [t, u])
            y, b, e = making.impacts(name, panel.edges, shipped.limits, number, s, t, u)
            varying = table.varying_edges(panel.edges, t, u)
            for x in np.broadcast_arrays(y, *table.edges_of(name, varying, b, e)[1:]):
                for axis in range(3):
                    row = [
                        beside(v) if i == axis else np.tile(v, 3) for i, v in enumerate((x, b, e))
                    ]
                    loss = np.full(x.size * 3, float(name != "viscous"))
                    yield np.stack([row[0], row[1], np.ones_like(loss), row[2], loss])


def case_of(name):
    """Every edge, one float beside it, bounds, what is refused, and random impacts."""
    random, shipped = np.random.default_rng(20), table.shipped(name)
    e, ratio = random.uniform(0.3, 1, COUNT), random.uniform(1.5625, 3.5, COUNT)
    e[::9], e[1::9], ratio[2::9], ratio[3::9] = 0.3, 1.0, 1.5625, 3.5
    for start, limit in zip((4, 13), shipped.limits, strict=True):
        between = np.interp(table.over_b(ratio), np.linspace(0, 1, limit.size), limit)
        e[start::18] = beside(between[start::54])[: e[start::18].size]
    beta = random.choice([2.5, 3.5], COUNT)
    x = random.uniform(-1.1, 1.1, COUNT) * (1 + e) * beta
    x[5::99], x[6::99], x[7::99], x[8::99] = 0.0, 5e-324, LARGEST, np.inf
    groups = [np.stack([x, beta, beta / ratio, e, np.arange(COUNT) % 2])]
    groups += sphere_edges(shipped, random)
    refused = np.tile([[2.0], [3.5], [1.21], [0.8], [1.0]], 5 * len(REFUSED))
    for i, value in enumerate(REFUSED):
        refused[range(5), range(5 * i, 5 * i + 5)] = value
    impacts = np.concatenate([*groups, refused], axis=1)
    x, beta, zeta2, e, loss = impacts
    with np.errstate(all="ignore"):
        good = (np.abs(x) <= LARGEST) & (beta >= 1) & spheres.covers(beta, zeta2, e)
        good &= (loss == 0) | (loss == 1)
        tabled = good & (np.abs(x) < np.maximum(zeta2, beta + e * (beta - zeta2)))
    words = np.array(spheres.LOSSES)[loss[good].astype(int)]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(table, "shipped", lambda: shipped)
        found = spheres.rebound(x[good], beta[good], zeta2[good], e[good], loss=words)
    constants = {"INCIDENCE_MAX": LARGEST, "RESTITUTION_MIN": 0.3, "RATIO_MIN": 1.5625}
    errors = {f"ERROR_{k.upper()}": v for k, v in export.BOUNDS[name].items()}
    constants |= {"STIFFNESS_MAX": 1.6, "RATIO_MAX": 3.5, "VISCOUS": 1, "PLASTIC": 2} | errors
    coded = np.array([x, beta, zeta2, e, loss + 1])
    return Case(constants, coded.T, answers(good, found.velocity, found), tabled)


def agrees(found, case):
    """Whether each of the five rows agrees; a value beyond the table has a bound of its own."""
    wanted, x = case.wanted, case.impacts[:, 0]
    nan = np.isnan(wanted)
    size = np.where(nan, 0.0, np.abs(wanted))
    bound = ACCURACY * np.maximum(size, size[:, case.tabled].max(axis=1, keepdims=True))
    same = (np.abs(found - wanted) <= bound) | (np.isnan(found) & nan)
    same &= (x != 0) | nan | (np.signbit(found) == np.signbit(wanted))
    return same.all(axis=1).tolist()


@pytest.fixture(scope="module")
def cases():
    return {name: case_of(name) for name in export.TABLES.values()}


@pytest.fixture(scope="module")
def folder(cases, tmp_path_factory):
    """Headers, modules and impacts, and those of `WRONG`."""
    folder = tmp_path_factory.mktemp("export")
    tolerances = {name: tolerance for tolerance, name in export.TABLES.items()}
    for name, (right, good, bad) in ({name: (name, "", "") for name in cases} | WRONG).items():
        for file, language in ((f"{name}.h", "c"), (f"{name}.mjs", "js")):
            export.write_spheres(folder / file, language, tolerances[right])
            code = (folder / file).read_text()
            assert good in code
            (folder / file).write_text(code.replace(good, bad))
        cases[right].impacts.tofile(folder / f"{name}.x")
    return folder


def compiled(folder, cases, compilers, *options):
    """Write constants and answers of the headers, all by one program."""
    program = next(filter(None, map(shutil.which, compilers)), None)
    if program is None:
        pytest.skip(f"no compiler: none of {', '.join(compilers)} is installed")
    runs = ""
    for name, case in cases.items():
        constants = ", ".join(f"{name.upper()}_{one}" for one in case.constants)
        runs += f"    RUN({name}, {constants});\n"
    headers = "".join(f'#include "{name}.h"\n' for name in cases)
    (folder / "run.c").write_text(f"{headers}{C}int main(void)\n{{\n{runs}    return 0;\n}}\n")
    command = [program, *options, *FLAGS]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    subprocess.run(["./run"], cwd=folder, check=True)


def c(folder, cases):
    compiled(folder, cases, ("cc", "gcc", "clang"), "-std=c99")


def cpp(folder, cases):
    compiled(folder, cases, ("c++", "g++", "clang++"), "-xc++")


def javascript(folder, cases):
    if not shutil.which("node"):
        pytest.skip("node is not installed")
    job = JAVASCRIPT.replace("FIELDS", json.dumps(FIELDS))
    constants = {name: list(case.constants) for name, case in cases.items()}
    (folder / "run.mjs").write_text(job.replace("CASES", json.dumps(constants)))
    subprocess.run(["node", "run.mjs"], cwd=folder, check=True)


@pytest.mark.parametrize("run", [c, pytest.param(cpp, marks=pytest.mark.long), javascript])
def test_other_languages_answer_as_python_does(run, cases, folder):
    every = cases | {name: cases[right] for name, (right, *_) in WRONG.items()}
    run(folder, every)
    for name, case in every.items():
        found = np.fromfile(folder / f"{name}.out")
        constants, rows = np.split(found, [len(case.constants)])
        same = agrees(rows.reshape(-1, 5).T, case)
        if name in WRONG:
            assert same == [False, False, False, False, True], name
        else:
            assert same == [True] * 5, name
            assert constants.tolist() == list(case.constants.values())


@pytest.mark.parametrize("compiler", [["cc", "-std=c99"], ["c++", "-xc++"]], ids=["C", "C++"])
def test_a_header_never_meets_a_compiler_without_nan(compiler, tmp_path):
    """That one may drop the test of the range, and a table is read beyond its ends."""
    if not shutil.which(compiler[0]):
        pytest.skip(f"{compiler[0]} is not installed")
    export.write_spheres(tmp_path / "balls.h", "c", 0.04)
    code = '#include "balls.h"\nint main(int n, char **v) { '
    code += "return balls_velocity(n / 0.0 - n / 0.0, 3.5, 1.2, 0.8, BALLS_PLASTIC)"
    (tmp_path / "main.c").write_text(f"{code} > 1 && v; }}\n")
    for options, works in {
        "-O3": True,
        "-O3 -ffast-math": False,
        "-O3 -ffinite-math-only": False,
        "-O3 -ffast-math -fno-finite-math-only": True,
    }.items():
        command = [*compiler, *options.split(), "main.c", "-o", "main", "-lm"]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
        assert (done.returncode == 0) == works, options
        assert works or "This header needs NaN" in done.stderr
        if works:
            subprocess.run(["./main"], cwd=tmp_path, check=True)


@pytest.mark.parametrize(
    ("language", "file", "commands"),
    [
        ("c", "main.c", [["cc", "-std=c99", "-O2", "main.c", "-lm"], ["./a.out"]]),
        ("js", "main.mjs", [["node", "main.mjs"]]),
    ],
)
def test_the_readme_prints_what_it_says(language, file, commands, tmp_path, monkeypatch):
    if not shutil.which(commands[0][0]):
        pytest.skip(f"{commands[0][0]} is not installed")
    monkeypatch.chdir(tmp_path)
    section = README.read_text(encoding="utf-8").split("## In C and JavaScript")[1]
    written = re.findall(rf"^\S+/planarimpact (.* --as {language} .*)$", section, flags=re.M)
    assert [main(shlex.split(command)) for command in written] == [0] * len(written)
    blocks = re.findall(rf"```{language}\n(.*?)```", section, flags=re.S)
    assert len(written) == len(blocks) == 1
    for text in blocks:
        (tmp_path / file).write_text(text)
        for command in commands:
            done = subprocess.run(command, check=True, capture_output=True, text=True)
        said = re.findall(r"^ *(?:printf|console.log)\(.*; // (.*)$", text, flags=re.M)
        assert said and done.stdout.splitlines() == said


# What a test changes in the README's loop for games: the peak after each impact and the place at
# the end are printed with all their digits; there is no friction; e, the steps a second and the
# height of the start are others.
PEAKS = {
    "position[0].toFixed(2)": "position[2] + velocity[2] ** 2 / (2 * gravity)",
    'places.slice(0, 3).join(" "), places.length, ': "...places, position[0], ",
    "{ body, pair } = spheres.presets.tennis_ball": "{ body } = spheres.presets.tennis_ball, "
    "pair = { friction: 0, stiffness_ratio: 1.5, restitution: E, loss: spheres.VISCOUS }",
    "1 / 60": "1 / STEPS",
    "k < 600": "k < 10 * STEPS",
    "position = [0, 0, 1]": "position = [0, 0, START]",
}


def test_the_loop_for_games_keeps_heights_and_comes_to_rest(tmp_path):
    if not shutil.which("node"):
        pytest.skip("node is not installed")
    blocks = re.findall(r"```js\n(.*?)```", README.read_text(encoding="utf-8"), flags=re.S)
    (loop,) = (block for block in blocks if "slow = " in block)
    for old, new in PEAKS.items():
        assert loop.count(old) == 1, old
        loop = loop.replace(old, new)
    export.write_spheres(tmp_path / "spheres.mjs", "js", 0.04)

    def peaks(e, steps, start):
        text = loop.replace("START", repr(start)).replace("STEPS", str(steps))
        (tmp_path / "main.mjs").write_text(re.sub(r"\bE\b", repr(e), text))
        done = subprocess.run(
            ["node", "main.mjs"], cwd=tmp_path, check=True, capture_output=True, text=True
        )
        *found, place, rests_at = map(float, done.stdout.split())
        assert place == pytest.approx(80, abs=1e-9)  # 8 m/s for 10 s, by no step more
        return np.array(found), rests_at

    radius = 0.0335
    for steps in (30, 60, 240):
        for e in (1.0, 0.9):
            found, _ = peaks(e, steps, 1.0)
            wanted = radius + (1 - radius) * e ** (2 * np.arange(1, 11))
            np.testing.assert_allclose(found[:10], wanted, rtol=0, atol=1e-9)
    # A ball that rests on the floor, just above it or in it stays there, or comes back to it.
    for e, start in ((0.1, 0.1), (1.0, radius), (1.0, radius + 1e-6), (0.9, radius - 1e-3)):
        found, rests_at = peaks(e, 60, start)
        assert rests_at == radius and found.tolist() == pytest.approx([radius], abs=2e-6)


@pytest.mark.parametrize(
    ("path", "language", "words"),
    [
        ("ball.h", "rust", "language = 'rust': allowed are c, js"),
        ("ball.h", "js", "ball.h: allowed are names that end in .mjs or .js"),
        ("ball.mjs", "c", "ball.mjs: allowed are names that end in .h"),
        ("2nd.h", "c", "2nd.h: allowed are names of letters from A to Z, digits and underscores"),
        ("_ball.h", "c", "_ball.h: allowed are names of letters"),
        ("b\u00e4ll.h", "c", "b\u00e4ll.h: allowed are names of letters"),
        ("no/ball.h", "c", "no/ball.h: there is no folder"),
    ],
)
def test_refusals_leave_no_file(path, language, words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InputError) as refused:
        export.write_spheres(path, language, 0.04)
    assert str(refused.value).startswith(words) and not list(tmp_path.iterdir())
