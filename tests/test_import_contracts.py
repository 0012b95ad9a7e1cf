"""Import contracts: which package may import which others, and by which public modules.

A package is here a folder or a file of a side, `src/planarimpact` or `src/stronge1994`. It may
import its own files and the packages in its line here; pandas, matplotlib and jinja2 only where its
line has them. tests/reference_solutions may import none of these packages.
"""

import ast
from pathlib import Path

import pytest

SRC = Path(__file__).parents[1] / "src"
# Codes that are compared with the solver, and so share nothing with it.
APART = "tests.reference_solutions"

# The solver. Models of contact do not know each other; nothing here knows the replication.
SOLVER = {
    "common": "",
    "normal_impact": "common",
    "rigid": "common",
    "phases": "common",
    "lumped": "common phases",
    "continuum": "common normal_impact",
    "bodies": "common normal_impact",
    "noncollinear": "common phases",
    "spheres": "common normal_impact continuum",
    "models": "common normal_impact rigid lumped continuum spheres bodies pandas",
    "export": "planarimpact common normal_impact collision spheres",
    "fit": "common normal_impact bodies continuum spheres models",
    "collision": "common normal_impact bodies lumped noncollinear continuum spheres models",
    "scene": "common bodies collision pandas",
    "_pyinstaller": "",
    "__init__": (
        "planarimpact common normal_impact rigid lumped continuum bodies noncollinear spheres"
        " models export fit collision scene"
    ),
    "__main__": ("planarimpact common bodies lumped continuum models export fit collision scene"),
}
# The replication. Only curves and checks of the paper solve; drawings get curves, pages tables.
REPLICATION = {
    "__init__": "",
    "names": "",
    "words": "names",
    "tables": "common pandas",
    "solving": "names pandas tables",
    "verdict_table": "tables",
    "figure_table": "names words pandas tables verdict_table",
    "formulas": "",
    "goodness": "common",
    "reference_data": "common pandas tables",
    "printed": "common lumped",
    "explorer": "planarimpact common lumped bodies collision reference_data pages",
    "figures/solving": "planarimpact common bodies rigid lumped continuum models"
    " pandas printed tables names figures",
    "figures/drawing": "planarimpact common tables names words goodness reference_data figures"
    " verdict_table matplotlib pandas",
    "studies/solving": "planarimpact common bodies rigid lumped continuum noncollinear models"
    " spheres scene pandas printed tables names figures studies settings",
    "studies/drawing": "planarimpact common tables names words goodness figures studies"
    " matplotlib pandas",
    "ledger_table": "tables",
    "paper": "common bodies rigid lumped continuum noncollinear models"
    " printed formulas tables ledger_table judging",
    "judging": "common pandas tables names formulas goodness reference_data verdict_table",
    "settings": "reference_data judging names",
    "versions": "planarimpact",
    "logs": "",
    "accepted": "tables verdict_table ledger_table",
    "answers": "tables words figure_table verdict_table ledger_table",
    "gate": "accepted answers tables figure_table verdict_table ledger_table",
    "pages": "planarimpact common bodies export tables reference_data figures studies formulas"
    " goodness judging paper ledger_table settings accepted answers gate versions names words"
    " figure_table verdict_table jinja2 pandas matplotlib",
}
# Figures and studies have one folder each, and in it files that solve and files that draw, or that
# judge what is drawn.
DRAWING = ("drawing", "draw_", "trials")
CONTRACTS = {"planarimpact": SOLVER, "stronge1994": REPLICATION}
# Of a package of the solver others import its `__init__` or one of these. In `common` and in the
# replication every module is public.
PUBLIC_MODULES = {
    "phases.closed",  # contacts that the loop follows, and their history
    "phases.off_centre",
    "phases.runs",
    "phases.viscous",
    "continuum.inelastic",  # single steps, and motions of one's own
    "normal_impact.hertz",
    "normal_impact.kelvin_voigt",
    "normal_impact.yielding",
    "lumped.one_impact",  # in floats, for `collide`
    "models.laws",
    "models.timestep",
    "noncollinear.rigid",
    "collision.facts",  # these three solve scenes
    "collision.mechanics",
    "collision.methods",
    "collision.presets",
    "spheres.table",  # which export writes in other languages, and which has one impact in floats
}


def broken_contracts(side, package, source):
    """Imports of a file of a package that the tables above do not allow."""
    for target in imported(source):
        top, *inner = target.split(".")
        name = inner[0] if inner and inner[0] in _names(top) else top
        if (top == side and name == package) or not (top in CONTRACTS or _is_listed(top)):
            continue
        if name not in CONTRACTS[side][package].split():
            yield f"{package} may not import {name}"
        of_figure = inner[:1] in (["figures"], ["studies"])
        if package.endswith("/drawing") and of_figure and inner[2:3] == ["curves"]:
            yield "a drawing never solves"
        file = SRC.joinpath(top, *inner[:2])
        is_module = len(inner) > 1 and (file.is_dir() or file.with_suffix(".py").is_file())
        if top == "planarimpact" and name != "common" and is_module:
            module = ".".join(inner[:2])
            if module not in PUBLIC_MODULES:
                yield f"{package} may not import {module}: it is no public module"


def imported(source):
    """Full names of what a file imports; those of relative imports begin with dots."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.ImportFrom):
            module = "." * node.level + (node.module or "")
            yield from (f"{module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)


def ties(source):
    """Imports that tie a second solution to the solver, themselves or through other tests."""
    for target in imported(source):
        top = target.split(".")[0]
        if top in CONTRACTS or (top in ("tests", "") and not target.startswith(f"{APART}.")):
            yield target


def _names(side):
    return {package.partition("/")[0] for package in CONTRACTS.get(side, ())}


def _files(side, package):
    """Files of a package; of the figures those that solve, or those that draw."""
    name, _, kind = package.partition("/")
    files = [SRC / side / f"{name}.py", *(SRC / side / name).rglob("*.py")]
    if kind:
        draws = {
            path: any(part.startswith(DRAWING) for part in path.relative_to(SRC).parts)
            for path in files
        }
        files = [path for path in files if draws[path] == (kind == "drawing")]
    return [path for path in files if path.exists()]


def _is_listed(name):
    """Whether a package from outside is one that the tables allow in some packages only."""
    return any(name in words.split() for side in CONTRACTS.values() for words in side.values())


@pytest.mark.parametrize("side", CONTRACTS)
def test_every_package_has_a_contract(side):
    found = {path.stem for path in (SRC / side).glob("[!.]*") if path.suffix in ("", ".py")}
    assert found - {"__pycache__", "py"} == _names(side)


@pytest.mark.parametrize(("side", "package"), [(s, p) for s in CONTRACTS for p in CONTRACTS[s]])
def test_packages_import_only_what_they_may(side, package):
    found = [
        f"{path}: {words}"
        for path in _files(side, package)
        for words in broken_contracts(side, package, path.read_text(encoding="utf-8"))
    ]
    assert not found


@pytest.mark.parametrize(
    ("side", "package", "source"),
    [
        ("planarimpact", "continuum", "from planarimpact import lumped"),
        ("planarimpact", "lumped", "def late():\n    import planarimpact.rigid"),
        ("planarimpact", "models", "from planarimpact.continuum import tangential_motion"),
        ("planarimpact", "collision", "import pandas as pd"),
        ("planarimpact", "rigid", "from stronge1994 import gate"),
        ("stronge1994", "figures/drawing", "from planarimpact.lumped import rebound"),
        ("stronge1994", "figures/drawing", "from stronge1994.figures.fig5 import curves"),
        ("stronge1994", "figures/solving", "from planarimpact.lumped.stick_slip import solve"),
        ("stronge1994", "judging", "import matplotlib.pyplot as plt"),
    ],
)
def test_a_broken_contract_is_seen(side, package, source):
    assert list(broken_contracts(side, package, source))


def test_second_solutions_share_nothing_with_the_solver():
    files = list(SRC.parent.joinpath(*APART.split(".")).rglob("*.py"))
    found = [f"{path}: {target}" for path in files for target in ties(path.read_text("utf-8"))]
    assert len(files) > 10 and not found
