"""What others install: wheel, source archive and environments; a quick import, examples."""

import ast
import importlib
import inspect
import json
import pydoc
import re
import runpy
import shutil
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path
from types import SimpleNamespace

import pytest
import yaml

import planarimpact
from tests.test_import_contracts import imported

ROOT = Path(__file__).parents[2]
# Packages of the index and of conda, by what is imported, where the names differ.
ON_INDEX = {"PIL": "pillow", "yaml": "pyyaml"}
ON_CONDA = ON_INDEX | {"matplotlib": "matplotlib-base"}
BUILD = (
    "import sys; from setuptools import build_meta; print(getattr(build_meta, sys.argv[1])('.'))"
)


def text(path):
    return (ROOT / path).read_text(encoding="utf-8")


def packages(path):
    """Names of the packages that a file imports."""
    return {name.split(".")[0] for name in imported(path.read_text(encoding="utf-8"))}


def built(kind, folder):
    result = subprocess.run(
        [sys.executable, "-c", BUILD, kind], cwd=folder, capture_output=True, text=True
    )
    assert result.returncode == 0, result.stderr
    return folder / result.stdout.split()[-1]


@pytest.mark.slow
def test_wheel_and_source_archive_hold_the_package_alone(tmp_path):
    """The archive has only tests that find there all that they need; the wheel is made from it."""
    source = tmp_path / "source"
    ignore = shutil.ignore_patterns("__pycache__", "*.egg-info")
    for part in ("src", "tests", "data/lumped_extremes", "data/lumped_viscous", "data/scenes"):
        shutil.copytree(ROOT / part, source / part, ignore=ignore)
    for name in ("pyproject.toml", "MANIFEST.in", "LICENSE", "CITATION.cff", "CHANGELOG.md"):
        shutil.copy(ROOT / name, source)
    with tarfile.open(built("build_sdist", source)) as archive:
        archive.extractall(tmp_path, filter="data")
    unpacked = tmp_path / f"planarimpact-{planarimpact.__version__}"
    code = {path.relative_to(unpacked) for path in unpacked.rglob("*.py")}
    for path in code:
        assert "stronge1994" not in packages(unpacked / path), f"{path}: exclude it in MANIFEST.in"
        source = ast.parse((unpacked / path).read_text(encoding="utf-8"))
        imports = [node for node in source.body if isinstance(node, ast.ImportFrom)]
        needed = {
            file if (ROOT / file).is_file() else file.with_suffix("") / f"{one.name}.py"
            for node in imports
            if node.module.startswith("tests.")
            for file in [Path(node.module.replace(".", "/") + ".py")]
            for one in node.names
        }
        assert needed <= code, f"{path} needs them: MANIFEST.in"
    assert len([path for path in code if path.name.startswith("test_")]) > 15
    with zipfile.ZipFile(built("build_wheel", unpacked)) as wheel:
        names = {name for name in wheel.namelist() if ".dist-info/" not in name}
        (script,) = [name for name in wheel.namelist() if name.endswith("/entry_points.txt")]
        entries = wheel.read(script).decode()
    for value in ("planarimpact = planarimpact.__main__:main", "hook-dirs = planarimpact._pyin"):
        assert value in entries
    files = [path for path in (ROOT / "src/planarimpact").rglob("*") if path.is_file()]
    known = {f"{path.relative_to(ROOT / 'src')}" for path in files if path.suffix != ".pyc"}
    assert names == known - {"planarimpact/README.md"}


def test_pyinstaller_finds_the_hook_and_the_hook_all_tables(monkeypatch):
    """The wheel's entry point names `hook_dirs`; here a stand-in for PyInstaller collects."""
    stub = SimpleNamespace(collect_data_files=lambda name: [name], collect_submodules=list)
    monkeypatch.setitem(sys.modules, "PyInstaller", SimpleNamespace(utils=None))
    monkeypatch.setitem(sys.modules, "PyInstaller.utils", SimpleNamespace(hooks=stub))
    monkeypatch.setitem(sys.modules, "PyInstaller.utils.hooks", stub)
    (folder,) = importlib.import_module("planarimpact._pyinstaller").hook_dirs()
    hook = runpy.run_path(f"{folder}/hook-planarimpact.py")
    assert hook["datas"] == ["planarimpact"] and hook["hiddenimports"]


def test_one_version():
    assert f"\nversion: {planarimpact.__version__}\n" in text("CITATION.cff")
    newest = re.search(r"^## (\S+), (in work|20\d\d-\d\d-\d\d)$", text("CHANGELOG.md"), flags=re.M)
    assert newest[1] == planarimpact.__version__
    released = re.search(r"^date-released: (.*)$", text("CITATION.cff"), flags=re.M)
    assert newest[2] == (released[1] if released else "in work")


def test_a_certifier_finds_each_figure_of_the_paper_in_the_manifest():
    """As version 2.0 of the specification asks. Whether the files are there: test_run.py."""
    written = text("codecheck.yml")
    assert written.startswith("---\n")
    config = yaml.safe_load(written)
    assert config["version"] == "https://codecheck.org.uk/spec/config/2.0/"
    assert {"title", "authors", "reference"} <= set(config["paper"])
    files = {entry["file"] for entry in config["manifest"]}
    assert {f"figures/fig{number}.svg" for number in range(2, 10)} <= files
    assert {"results/verdicts.csv", "data/accepted/verdicts.csv"} <= files


def test_the_citation_has_the_doi_of_the_paper():
    (paper,) = yaml.safe_load(text("CITATION.cff"))["references"]
    reference = yaml.safe_load(text("codecheck.yml"))["paper"]["reference"]
    assert reference == f"https://doi.org/{paper['doi']}"


def test_the_page_for_the_index_links_to_nothing_beside_it():
    assert re.findall(r"\]\((?!https://)(.*?)\)", text("src/planarimpact/README.md")) == []


def test_environments_have_what_the_run_imports():
    files = [*ROOT.glob("src/**/*.py"), *ROOT.glob("workflow/scripts/*.py")]
    names = set().union(*map(packages, files)) - {""}  # of relative imports
    names -= {*sys.stdlib_module_names, "planarimpact", "stronge1994"}
    names -= {"typing_extensions"}  # type checkers have it, and only they read it
    names -= {"PyInstaller"}  # which runs our hook
    names -= {"IPython"}  # in a cell of a notebook, whose kernel brings it
    pinned = dict(re.findall(r"^([\w-]+)==(.*)$", text("environment.txt").lower(), flags=re.M))
    conda = text("workflow/envs/planarimpact.yaml")
    conda = dict(re.findall(r"^  - ([\w-]+)(?: =(.*))?$", conda, flags=re.M))
    assert len(names) > 15
    assert {ON_INDEX.get(name, name) for name in names} - set(pinned) == set()
    assert {ON_CONDA.get(name, name) for name in names} - set(conda) == set()
    index = {on_conda: name for name, on_conda in ON_CONDA.items()}
    for name, version in conda.items():
        if version and name != "python":
            assert f"{pinned[index.get(name, name)]}.".startswith(f"{version}."), name


def test_the_container_runs_the_main_command():
    command = re.search(r"<!-- main -->\n```sh\n(.*)\n", text("README.md"))[1]
    steps = re.findall(r"^(?:RUN|CMD) (.*)$", text("Containerfile"), flags=re.M)
    assert " && ".join([*steps[:-1], " ".join(json.loads(steps[-1]))]) == command


def test_the_import_is_quick_and_has_all_modules():
    """Of sources that are not installed, too."""
    code = (
        "import sys, planarimpact; assert not {'scipy', 'pandas', 'pyarrow'} & set(sys.modules);"
        "print(planarimpact.lumped.rebound(8.0).velocity, planarimpact.__version__)"
    )
    command = [sys.executable, "-c", code]
    result = subprocess.run(command, cwd=ROOT / "src", capture_output=True, text=True)
    assert result.stdout == f"1.0 {planarimpact.__version__}\n", result.stderr


def test_every_function_that_the_package_recommends_has_an_example():
    functions = 0
    for name in re.findall(r"`([a-z_.]+)`", planarimpact.__doc__):
        path = ROOT / "src/planarimpact" / name.replace(".", "/")
        if not path.is_dir() and not path.with_suffix(".py").is_file():
            continue
        module = importlib.import_module(f"planarimpact.{name}")
        stated = getattr(module, "__all__", ())
        for each in stated or [each for each in vars(module) if each[0] != "_"]:
            function = getattr(module, each)
            if inspect.isroutine(function) and (stated or function.__module__ == module.__name__):
                functions += 1
                assert "\nExamples\n---" in inspect.getdoc(function), f"{name}.{each}"
    assert functions > 15


def test_help_shows_what_is_our_own():
    """Fields and names of records, and not methods of tuples; ArrayLike, and not what it means."""
    bodies, lumped = planarimpact.bodies, planarimpact.lumped
    kinds = [kind for kind in vars(planarimpact).values() if isinstance(kind, type)]
    records = [kind for kind in kinds if issubclass(kind, (tuple, int, str))]
    assert len(records) >= 5
    for record in [*records, bodies.Body, bodies.Material]:
        shown = pydoc.plain(pydoc.render_doc(record))
        assert "builtins.tuple:" not in shown and "builtins.int:" not in shown, record
    for function in (lumped.rebound, bodies.solid_sphere, planarimpact.collide):
        assert "'ArrayLike'" in pydoc.plain(pydoc.render_doc(function))
