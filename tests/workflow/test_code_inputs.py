"""What a job imports from src/ is an input of its rule: else an edit of it runs nothing."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.workflow.project import ROOT, Project

# Imports what each script imports, and names the files in src/ that were loaded. A fork for each,
# as the imports of numpy, pandas and matplotlib take most of the time.
RECORD = """
import ast, importlib, json, os, sys
import matplotlib.figure, pandas, scipy.integrate

def loaded(script, modules):
    imports = [node for node in ast.walk(ast.parse(open(script).read()))
               if isinstance(node, ast.Import | ast.ImportFrom)]
    exec(compile(ast.Module(imports, []), script, "exec"), {})
    for module in modules:
        importlib.import_module(module)
    paths = [getattr(module, "__file__", None) or "" for module in sys.modules.values()]
    return [path for path in map(os.path.relpath, filter(None, paths)) if path.startswith("src/")]

for script, *modules in json.load(sys.stdin):
    sys.stdout.flush()
    if not os.fork():
        print(json.dumps([[script, *modules], loaded(script, modules)]), flush=True)
        os._exit(0)
    os.wait()
"""
# Modules that a script imports by names made at run time.
BY_NAME = {"solve": r"/curves\.py$", "draw": r"/drawing\.py$"}


@pytest.fixture(scope="module")
def inputs():
    """Inputs of each job, `{(script, module, ...): paths}`, as a dry run names them."""
    asked = ["all", "accept", "fig6", "lite", "--dry-run", "--forceall", "--nolock"]
    said = Project(ROOT).run(*asked, "--workflow-profile", "none").stdout
    found = {}
    for line in re.findall(r"^    input: (.*)$", said, flags=re.M):
        paths = line.split(", ")
        for script in {path for path in paths if path.startswith("workflow/scripts/")}:
            kind = BY_NAME.get(Path(script).stem)
            own = [path for path in paths if kind and re.search(kind, path)]
            modules = [path.removeprefix("src/")[:-3].replace("/", ".") for path in own]
            found[script, *modules] = set(paths)
    return found


def test_each_module_that_a_job_imports_is_an_input_of_it(inputs):
    scripts = {path.name for path in (ROOT / "workflow/scripts").iterdir() if path.suffix == ".py"}
    assert {Path(job[0]).name for job in inputs} == scripts
    result = subprocess.run(
        [sys.executable, "-c", RECORD],
        input=json.dumps(list(inputs)),
        cwd=ROOT,
        env={"PYTHONPATH": "src"},
        capture_output=True,
        text=True,
        check=True,
    )
    rows = [json.loads(line) for line in result.stdout.splitlines()]
    assert len(rows) == len(inputs) > 30
    missing = {(job[0], path) for job, paths in rows for path in {*paths} - inputs[tuple(job)]}
    assert not missing


def test_no_import_waits_until_a_function_is_called():
    """Else the test above would not see it. What is imported by a name has its folder as input."""
    late = r"import_module\(|__import__|runpy|^ +(from|import) (planarimpact|stronge1994|\.)"
    files = (ROOT / "src/stronge1994").rglob("*.py")
    found = {
        f"{path.relative_to(ROOT)}"
        for path in files
        if re.search(late, path.read_text("utf-8"), re.M)
    }
    assert found == {
        "src/stronge1994/solving.py",
        "src/stronge1994/figures/shared/drawing/__init__.py",
        "src/stronge1994/paper/__init__.py",
        "src/stronge1994/pages/student.py",  # the text of a cell
    }
