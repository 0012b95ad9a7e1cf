"""What an import loads; and the digest of code, which changes with each module that is reached."""

import re
import shutil
import subprocess
import sys

import pytest

import planarimpact
from stronge1994 import imports

SRC = imports.SRC
# A job, what its modules import, and data beside them.
REACHED = {
    "job.py": "from house.rooms import (  # several lines\n    cellar as below,\n    hall,\n)\n",
    "src/house/rooms/cellar.py": "def late():\n    import house.garden, house.shed as hut\n",
    "src/house/rooms/hall.py": "from house.tools.drill import bit\n",
    "src/house/garden.py": "from house.roof import tile\n",
    "src/house/shed.py": "from house.rooms import hall  # round in a circle\n",
    "src/house/roof/__init__.py": "tile = 1\n",
    "src/house/tools/drill.py": "import numpy\nfrom . import bolt\nfrom ..shed import door\n",
    "src/house/tools/bolt.py": "",
    "src/house/tools/sizes.toml": "",
    "src/house/tools/templates/form.jinja2": "",
}
OTHERS = {"src/house/rooms/__init__.py": "", "src/house/attic.py": "", "src/house/tools/a.md": ""}
OTHERS |= {"src/house/tools/.drill.swp": "", "src/house/rooms/.#hall.py": ""}


@pytest.fixture
def digest(tmp_path, monkeypatch):
    """Function: the digest of a job in a copy of sources, anew."""
    monkeypatch.setattr(imports, "SRC", tmp_path / "src")

    def anew(*paths):
        imports._of_file.cache_clear()
        imports._data.cache_clear()
        return imports.digest([tmp_path / path for path in paths])

    yield anew
    imports._of_file.cache_clear()


@pytest.mark.parametrize("edited", [*REACHED, *OTHERS])
def test_each_module_that_is_imported_counts_with_its_data(edited, digest, tmp_path):
    for path, text in (REACHED | OTHERS).items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    before = digest("job.py")
    with open(tmp_path / edited, "a") as file:
        file.write("# edited")
    assert (digest("job.py") != before) == (edited in REACHED)


FIG6 = "src/stronge1994/figures/fig6"


@pytest.mark.parametrize(
    ("paths", "edited", "counts"),
    [
        ([f"{FIG6}/curves.py"], "planarimpact/lumped/by_loss.py", True),
        ([f"{FIG6}/curves.py"], "planarimpact/export/__init__.py", False),
        (
            ["workflow/scripts/draw.py", f"{FIG6}/drawing.py"],
            "planarimpact/lumped/by_loss.py",
            False,
        ),
        (["workflow/scripts/solve_scene.py"], "planarimpact/collision/presets.toml", True),
        (["src/planarimpact"], "planarimpact/spheres/fine.npz", True),
    ],
)
def test_solving_and_drawing_wait_for_their_own_modules(paths, edited, counts, digest, tmp_path):
    for folder in ("src", "workflow/scripts"):
        shutil.copytree(SRC.parent / folder, tmp_path / folder)
    before = digest(*paths)
    with open(tmp_path / "src" / edited, "a") as file:
        file.write("# edited")
    assert (digest(*paths) != before) == counts


def test_no_import_is_hidden_from_the_digest():
    """A module that is imported by a name made at run time stands in the rule that needs it."""
    hidden = r"import_module\(|__import__|runpy|^ *(?:.*;|.*:) *import "
    texts = {path.relative_to(SRC): path.read_text("utf-8") for path in SRC.rglob("*.py")}
    assert {f"{path}" for path, text in texts.items() if re.search(hidden, text, flags=re.M)} == {
        "planarimpact/__init__.py",  # its names stand below TYPE_CHECKING too
        "stronge1994/solving.py",
        "stronge1994/figures/shared/drawing/__init__.py",
        "stronge1994/ledger/__init__.py",
    }


def printed(code):
    """What a fresh interpreter prints."""
    command = [sys.executable, "-c", code]
    return subprocess.run(command, cwd=SRC, check=True, capture_output=True, text=True).stdout


@pytest.mark.parametrize(
    ("code", "loaded"),
    [
        ("import planarimpact", "common"),
        ("from planarimpact import Regime, InputError", "common"),
        ("import planarimpact as p; dir(p); hasattr(p, 'solver')", "common"),
        ("from planarimpact import rigid", "common rigid"),
        ("from planarimpact import ContinuumHistory", "common continuum normal_impact"),
    ],
)
def test_what_is_not_used_is_not_loaded(code, loaded):
    code += "\nimport sys\nprint(*{'.'.join(name.split('.')[:2]) for name in sys.modules})"
    names = set(printed(code).split())
    assert not {name.split(".")[0] for name in names} & {"scipy", "pandas", "pyarrow", "tomllib"}
    ours = {name for name in names if name.startswith("planarimpact.")}
    assert ours == {f"planarimpact.{name}" for name in loaded.split()}


def test_every_name_of_the_package_can_be_used_first_and_is_listed():
    code = "import planarimpact as p; print(set(p.__all__) - set(dir(p)), {0}.__name__, {0} is {0})"
    for name in planarimpact.__all__:
        own = getattr(planarimpact, name).__name__
        assert printed(code.format(f"p.{name}")) == f"set() {own} True\n"
    code = "from planarimpact import *; print({*__import__('planarimpact').__all__} - {*globals()})"
    assert printed(code) == "set()\n"
    with pytest.raises(AttributeError, match="module 'planarimpact' has no attribute 'solver'"):
        _ = planarimpact.solver


def test_each_module_of_the_package_can_be_imported_first():
    code = "import importlib, sys, numpy\nothers = {*sys.modules}\n"
    for path in (SRC / "planarimpact").rglob("*.py"):
        name = ".".join(path.relative_to(SRC).with_suffix("").parts).removesuffix(".__init__")
        code += f"importlib.import_module({name!r})\n"
        code += "for name in {*sys.modules} - others:\n"
        code += "    if name.startswith('planarimpact'): del sys.modules[name]\n"
    assert printed(code) == ""
