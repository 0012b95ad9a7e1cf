"""Responses in C and JavaScript compute what they compute in Python, at every edge."""

import base64
import json
import re
import shlex
import shutil
import subprocess
from pathlib import Path

import browser
import numpy as np
import pytest

from planarimpact import InputError, Regime, export, response
from planarimpact.__main__ import main

README = Path(__file__).parents[2] / "src/README.md"
COUNT = 100_000
ACCURACY = 1e-14  # of the largest value
LARGEST = 8e307  # incidence
PAIRS = {
    "plain": ("lumped.viscous", 1e-6, {"restitution": 0.8}),
    "silent": ("laws.smith", 1e-6, {"restitution": 0.5}),  # without peak friction
    "gaining": ("timestep.mindlin", 1e-2, {"mass_ratio": 1.0}),  # energy; up to INCIDENCE_MAX only
    "many": ("lumped", 1e-10, {"mass_ratio": 8.0, "stiffness_ratio": 0.03}),  # more than 256 pieces
}
CONSTANTS = (
    "MASS_RATIO",
    "STIFFNESS_RATIO",
    "RESTITUTION",
    "INCIDENCE_MAX",
    "ERROR_VELOCITY",
    "ERROR_PEAK_FRICTION",
)
FIELDS = "velocity", "peak_friction", "dissipation", "regime"
FLAGS = [
    *("-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Wdouble-promotion"),
    *("-Werror", "-O2", "run.c", "-o", "run", "-lm"),
]
# For each pair: the constants, then velocity(x) and the fields of rebound(x) for each x.
C = """\
#include <stdio.h>
#define RUN(p, P) \\
    do { \\
        const double constants[] = {P##_CONSTANTS}; \\
        double x; \\
        FILE *in = fopen(#p ".x", "rb"), *out = fopen(#p ".out", "wb"); \\
        if (!in || !out) \\
            return 1; \\
        fwrite(constants, sizeof constants, 1, out); \\
        while (fread(&x, sizeof x, 1, in) == 1) { \\
            const struct p##_result r = p##_rebound(x); \\
            const double row[] = {p##_velocity(x), r.FIELDS}; \\
            fwrite(row, sizeof row, 1, out); \\
        } \\
        fclose(in); \\
        fclose(out); \\
    } while (0)
"""
C = C.replace("r.FIELDS", ", ".join(f"(double)r.{name}" for name in FIELDS))
C = C.replace("P##_CONSTANTS", ", ".join("P##_" + name for name in CONSTANTS))
JAVASCRIPT = """\
(async () => {
    const found = {};
    const bytes = (text) => {
        const letters = atob(text), all = new Uint8Array(letters.length);
        for (let i = 0; i < all.length; i += 1) all[i] = letters.charCodeAt(i);
        return all;
    };
    for (const [name, [address, input]] of Object.entries(PAIRS)) {
        const module = await import(address), x = new Float64Array(bytes(input).buffer);
        const rows = CONSTANTS.map((name) => module[name]);
        for (const one of x) {
            const state = module.rebound(one);
            rows.push(module.velocity(one), ...FIELDS.map((field) => state[field]));
        }
        const parts = [], all = new Uint8Array(Float64Array.from(rows).buffer);
        for (let i = 0; i < all.length; i += 8192)
            parts.push(String.fromCharCode(...all.subarray(i, i + 8192)));
        found[name] = btoa(parts.join(""));
    }
    return JSON.stringify(found);
})()
"""


def impacts(built):
    """Incidences of both signs: every edge, one float beside it, what is refused, and random."""
    cells = np.arange(4097) / 4096 * built.pieces.end
    edges = [built.slides_from, built.incidence_max, 1.0, LARGEST, np.inf, np.nan, 0.0, 5e-324]
    edges = np.concatenate([built.pieces.start, cells, edges])
    edges = np.concatenate([edges, np.nextafter(edges, 0), np.nextafter(edges, np.inf)])
    random = np.random.default_rng(1994).uniform(0, 1.2 * built.pieces.end, COUNT // 2 - edges.size)
    sizes = np.concatenate([edges, random])
    return np.concatenate([sizes, -sizes])


def expected(built, x):
    """What Python answers, shape (5, n), and where it refuses what stands for that."""
    good = np.abs(x) <= min(built.incidence_max, LARGEST)
    found = np.full((5, x.size), np.nan)
    found[4] = Regime.UNRESOLVED
    found[:, good] = np.stack([built.velocity(x[good]), *built(x[good])[:4]])
    return found


def agrees(found, wanted, x, end):
    """Whether each of the five rows agrees; a value beyond the pieces has a bound of its own."""
    nan, inside = np.isnan(wanted), np.abs(x) <= end
    size = np.where(nan, 0.0, np.abs(wanted))
    bound = ACCURACY * np.maximum(size, size[:, inside].max(axis=1, keepdims=True))
    same = (np.abs(found - wanted) <= bound) | (np.isnan(found) & nan)
    same &= (x != 0) | nan | (np.signbit(found) == np.signbit(wanted))
    return same.all(axis=1).tolist()


@pytest.fixture(scope="module")
def pairs():
    """Responses, incidences and answers by name."""
    groups = {"mass_ratio": 3.5, "stiffness_ratio": 1.21}
    found = {}
    for name, (model, tolerance, given) in PAIRS.items():
        built = response.compile(model, incidence_max=20, tolerance=tolerance, **groups | given)
        x = impacts(built)
        found[name] = built, x, expected(built, x)
    assert found["gaining"][0].gains and len(found["many"][0].pieces.start) > 256
    assert np.isinf(found["plain"][0].incidence_max) and not found["plain"][0].gains
    return found


@pytest.fixture(scope="module")
def folder(pairs, tmp_path_factory):
    """Headers, modules and incidences; `wrong` is `plain` with two coefficients too large."""
    folder = tmp_path_factory.mktemp("export")
    for file, language in (("{}.h", "c"), ("{}.mjs", "js")):
        for name, (built, x, _) in pairs.items():
            export.write(built, folder / file.format(name), language)
            x.tofile(folder / f"{name}.x")
        built = pairs["plain"][0]
        text = export.text(built, file.format("wrong"), language)
        for value in map(float, built.pieces.coefficients[:, 0, 3]):
            assert text.count(repr(value)) == 1
            text = text.replace(repr(value), repr(value * (1 + 1e-10)))
        (folder / file.format("wrong")).write_text(text)
    shutil.copy(folder / "plain.x", folder / "wrong.x")
    return folder


def compiled(folder, names, compilers, *options):
    """Answers of the headers, all in one program."""
    program = next(filter(None, map(shutil.which, compilers)), None)
    if program is None:
        pytest.skip(f"no compiler: none of {', '.join(compilers)} is installed")
    runs = "".join(f"    RUN({name}, {name.upper()});\n" for name in names)
    headers = "".join(f'#include "{name}.h"\n' for name in names)
    (folder / "run.c").write_text(f"{headers}{C}int main(void)\n{{\n{runs}    return 0;\n}}\n")
    command = [program, *options, *FLAGS]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    subprocess.run(["./run"], cwd=folder, check=True)
    return {name: np.fromfile(folder / f"{name}.out") for name in names}


def c(folder, names):
    return compiled(folder, names, ("cc", "gcc", "clang"), "-std=c99")


def cpp(folder, names):
    return compiled(folder, names, ("c++", "g++", "clang++"), "-xc++")


def javascript(folder, names):
    """Answers of the modules, by node or else by a browser."""

    def code(path):
        return base64.b64encode(path.read_bytes()).decode()

    given = {
        name: (f"data:text/javascript;base64,{code(folder / (name + '.mjs'))}", code(x))
        for name, x in ((name, folder / f"{name}.x") for name in names)
    }
    job = JAVASCRIPT
    for word, value in {"PAIRS": given, "CONSTANTS": CONSTANTS, "FIELDS": FIELDS}.items():
        job = job.replace(word, json.dumps(value))
    if shutil.which("node"):
        (folder / "run.mjs").write_text(f"console.log(await {job})")
        command = ["node", "run.mjs"]
        done = subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True)
        found = json.loads(done.stdout)
    else:
        with browser.page() as tab:
            found = json.loads(tab.evaluate(job))
    return {name: np.frombuffer(base64.b64decode(text)) for name, text in found.items()}


@pytest.mark.parametrize("run", [c, cpp, javascript])
def test_other_languages_answer_as_python_does(run, pairs, folder):
    found = run(folder, [*pairs, "wrong"])
    for name, (built, x, wanted) in pairs.items():
        constants, rows = np.split(found[name], [len(CONSTANTS)])
        said = *list(built.parameters.values())[:3], min(built.incidence_max, LARGEST)
        assert constants.tolist() == [*said, *built.error_bound]
        assert agrees(rows.reshape(-1, 5).T, wanted, x, built.pieces.end) == [True] * 5, name
    built, x, wanted = pairs["plain"]
    rows = found["wrong"][len(CONSTANTS) :].reshape(-1, 5).T
    assert agrees(rows, wanted, x, built.pieces.end) == [False, False, False, False, True]


@pytest.mark.parametrize(
    ("block", "file", "commands"),
    [
        ("c", "main.c", [["cc", "-std=c99", "-O2", "main.c", "-lm"], ["./a.out"]]),
        ("js", "main.mjs", [["node", "main.mjs"]]),
    ],
)
def test_the_readme_prints_what_it_says(block, file, commands, tmp_path, monkeypatch):
    if not shutil.which(commands[0][0]):
        pytest.skip(f"{commands[0][0]} is not installed")
    monkeypatch.chdir(tmp_path)
    section = README.read_text(encoding="utf-8").split("## In C and JavaScript")[1]
    (command,) = re.findall(rf"^\S+/planarimpact (.* --as {block} .*)$", section, flags=re.M)
    assert main(shlex.split(command)) == 0
    text = re.search(rf"```{block}\n(.*?)```", section, flags=re.S)[1]
    (tmp_path / file).write_text(text)
    for command in commands:
        done = subprocess.run(command, check=True, capture_output=True, text=True)
    said = re.findall(r"^ *(?:printf|console.log)\(.*; // (.*)$", text, flags=re.M)
    assert said and done.stdout.splitlines() == said


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
def test_refusals_leave_no_file(path, language, words, pairs, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InputError) as refused:
        export.write(pairs["plain"][0], path, language)
    assert str(refused.value).startswith(words) and not list(tmp_path.iterdir())
