"""What a job imports from src/ is an input of its rule: else an edit of it runs nothing."""

import json
import re
import subprocess
import sys

import pytest

from tests.workflow.project import ROOT, Project

JOB = ROOT / "workflow/scripts/job.py"
# Imports what each function of the script imports, and names the files in src/ that were loaded. A
# fork for each, as the imports of numpy, pandas and matplotlib take most of the time.
RECORD = """
import ast, importlib, json, os, sys
import matplotlib.figure, pandas, scipy.integrate

tree = ast.parse(open("workflow/scripts/job.py").read())
jobs = {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}

def loaded(rule, modules):
    imports = [node for node in ast.walk(jobs[rule])
               if isinstance(node, ast.Import | ast.ImportFrom)]
    exec(compile(ast.Module(imports, []), rule, "exec"), {})
    for module in modules:
        importlib.import_module(module)
    paths = [getattr(module, "__file__", None) or "" for module in sys.modules.values()]
    return [path for path in map(os.path.relpath, filter(None, paths)) if path.startswith("src/")]

for rule, *modules in json.load(sys.stdin):
    sys.stdout.flush()
    if not os.fork():
        print(json.dumps([[rule, *modules], loaded(rule, modules)]), flush=True)
        os._exit(0)
    os.wait()
"""
# Modules that a job imports by names made at run time.
BY_NAME = {"curves": r"/curves\.py$", "draw": r"/drawing\.py$"}
# Rules that do what another one does.
ALIKE = {"draw_with_slide": "draw", "gate_of_target": "gate"}


@pytest.fixture(scope="module")
def inputs():
    """Inputs of each job, `{(rule, module, ...): paths}`, as a dry run names them."""
    asked = ["all", "accept", "fig6", "lite", "--dry-run", "--forceall", "--nolock"]
    said = Project(ROOT).run(*asked, "--workflow-profile", "none").stdout
    found = {}
    for name, line in re.findall(r"rule (\w+):\n    input: (.*)$", said, flags=re.M):
        paths, rule = line.split(", "), ALIKE.get(name, name)
        if f"{JOB.relative_to(ROOT)}" in paths:
            kind = BY_NAME.get(rule)
            own = [path for path in paths if kind and re.search(kind, path)]
            modules = [path.removeprefix("src/")[:-3].replace("/", ".") for path in own]
            found[rule, *modules] = set(paths)
    return found


def test_each_module_that_a_job_imports_is_an_input_of_it(inputs):
    functions = set(re.findall(r"^def (\w+)", JOB.read_text(), re.M))
    assert {job[0] for job in inputs} == functions - {"job"}
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
