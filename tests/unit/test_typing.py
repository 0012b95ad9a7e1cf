"""What users and editors rely on: types, docstrings, and a quick import."""

import importlib
import inspect
import pkgutil
import re
import subprocess
import sys
from pathlib import Path

import pytest

import planarimpact

ROOT = Path(__file__).parents[2]
PACKAGE = "planarimpact"
MODULES = [module.name for module in pkgutil.walk_packages(planarimpact.__path__, "planarimpact.")]
# What the heading of the package recommends.
API = sorted(
    set(re.findall(r"`([a-z_.]+)`", planarimpact.__doc__))
    & {name.removeprefix("planarimpact.") for name in MODULES}
)
FRESH = """
import sys
import planarimpact

assert not {"scipy", "pandas", "pyarrow"} & set(sys.modules), "import is slow"
print(planarimpact.lumped.rebound(8.0).velocity, planarimpact.__version__)
"""
RIGHT = """\
from planarimpact import lumped, noncollinear

print(lumped.rebound(1.0).regime.name)
print(noncollinear.rebound(1.0, 1.0, noncollinear.InverseMass(1.0, 0.0, 1.0), 0.5).regime.name)
"""
# Without an import of the modules.
RIGHT += "import planarimpact\n\nfloat(planarimpact.lumped.rebound(1.0).velocity)\n"
WRONG = """\
import planarimpact
from planarimpact import bodies, lumped

lumped.rebound(1.0, restitution=None)
lumped.rebound(1.0, restituton=0.5)
lumped.history([1.0, 2.0])
bodies.mass_ratio(0.0127)
print(lumped.rebound(1.0).speed)
planarimpact.lumped.rebound(1.0, restitution=None)
print(planarimpact.lumpd)
"""
REFUSED = [(4, "arg-type"), (5, "call-arg"), (6, "arg-type"), (7, "arg-type"), (8, "attr-defined")]
REFUSED += [(9, "arg-type"), (10, "attr-defined")]


def run(*command, cwd=ROOT, **options):
    return subprocess.run(
        [sys.executable, *command], cwd=cwd, capture_output=True, text=True, **options
    )


@pytest.mark.long  # mypy reads all of numpy first
def test_users_profit_from_the_types(tmp_path):
    """Examples, as in the READMEs, pass; each wrong call is refused, by the installed package."""
    readmes = [ROOT / "src/README.md", ROOT / "src/planarimpact/README.md"]
    texts = "\n".join(path.read_text(encoding="utf-8") for path in readmes)
    examples = re.findall(r"```python\n(.*?)```", texts, flags=re.S)
    assert examples
    examples.append(RIGHT)
    for i, text in enumerate([*examples, WRONG]):
        (tmp_path / f"example_{i}.py").write_text(text, encoding="utf-8")
    config = f"--config-file={ROOT / 'pyproject.toml'}"
    names = (f"example_{i}.py" for i in range(len(examples) + 1))
    result = run("-m", "mypy", config, *names, cwd=tmp_path)
    errors = re.findall(r"^example_(\d+)\.py:(\d+): error: .*\[([\w-]+)\]$", result.stdout, re.M)
    assert f"Found {len(REFUSED)} errors" in result.stdout, result.stdout
    last = str(len(examples))
    assert errors == [(last, str(line), code) for line, code in REFUSED], result.stdout


def test_the_import_is_quick_and_has_all_rooms():
    """Of sources that are not installed, too."""
    result = run("-c", FRESH, cwd=ROOT / "src")
    assert result.stdout == f"1.0 {planarimpact.__version__}\n", result.stderr


def routines(module):
    """Public functions of a module, and methods of its classes; by name."""
    names = getattr(module, "__all__", None) or [
        name
        for name, value in vars(module).items()
        if name[0] != "_" and getattr(value, "__module__", "") == module.__name__
    ]
    own = {name: getattr(module, name) for name in names}
    methods = {
        f"{name}.{method}": function
        for name, value in own.items()
        if inspect.isclass(value) and value.__module__.startswith(PACKAGE)
        for method, function in vars(value).items()
        if inspect.isroutine(function) and method[0] != "_"
    }
    return {n: f for n, f in own.items() if inspect.isroutine(f)} | methods


@pytest.mark.parametrize("room", API)
def test_what_is_recommended_is_documented_in_full(room):
    """Ruff asks for a docstring and types. Here: for the sections that a caller needs.

    A method may have its example in that of its class. What several functions share may stand in
    the docstring of the room, to which theirs points.
    """
    module = importlib.import_module(f"{PACKAGE}.{room}")
    for name, function in routines(module).items():
        signature, text = inspect.signature(function), inspect.getdoc(function)
        wanted = set() if signature.return_annotation is None else {"Returns"}
        if set(signature.parameters) - {"self", "cls"}:
            wanted |= {"Parameters"} if "." in name else {"Parameters", "Examples"}
        if f"rguments and errors: `{module.__name__}`" in " ".join(text.split()):
            wanted -= {"Parameters", "Returns"}
            assert all(f"`{each}`" in text + module.__doc__ for each in signature.parameters), name
        found = re.findall(r"^(\w+)\n-+$", text, flags=re.M)
        assert wanted <= set(found), name
