"""What the script of a rule imports from src/ is an input of that rule: else an edit runs nothing."""

import json
import subprocess
import sys

import pytest

from tests.workflow.project import ROOT, Project

# Imports what each script imports, and names the files in src/ that were loaded. A fork for each, as
# the imports of numpy, pandas and matplotlib take most of the time.
RECORD = """
import ast, importlib, json, os, sys
import matplotlib.figure, pandas, scipy.integrate

def loaded(script, module):
    imports = [node for node in ast.walk(ast.parse(open(script).read()))
               if isinstance(node, ast.Import | ast.ImportFrom)]
    exec(compile(ast.Module(imports, []), script, "exec"), {})
    if module:
        importlib.import_module(module)
    paths = [getattr(module, "__file__", None) or "" for module in sys.modules.values()]
    return [path for path in map(os.path.relpath, filter(None, paths)) if path.startswith("src/")]

for script, module in json.load(sys.stdin):
    sys.stdout.flush()
    if not os.fork():
        print(json.dumps([script, module, loaded(script, module)]), flush=True)
        os._exit(0)
    os.wait()
"""
OF_FIGURE = {"solve": "curves", "draw": "drawing"}  # which module of the folder a script imports


@pytest.fixture(scope="module")
def inputs():
    """Inputs of each job, `{(script, module of a figure): paths}`, as Snakemake knows them."""
    said = Project(ROOT).run("all", "site", "accept", "fig6", "--detailed-summary").stdout
    lines = said.partition("output_file\t")[2].splitlines()
    columns = "output_file\t".join(["", lines[0]]).split("\t")
    found = {}
    for line in lines[1:]:
        row = dict(zip(columns, line.split("\t"), strict=False))
        paths = row.get("input-file(s)", "").split(",")
        for script in {path for path in paths if path.startswith("workflow/scripts/")}:
            kind = OF_FIGURE.get(script.split("/")[-1].removesuffix(".py"))
            own = [path for path in paths if path.endswith(f"/{kind}.py")]
            module = own[0].removeprefix("src/")[:-3].replace("/", ".") if kind else ""
            found[script, module] = set(paths)
    return found


def test_each_module_that_a_job_imports_is_an_input_of_it(inputs):
    scripts = {path.name for path in (ROOT / "workflow/scripts").iterdir() if path.suffix == ".py"}
    assert {script.split("/")[-1] for script, _ in inputs} == scripts - {"accept.py"}
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
    assert len(rows) == len(inputs) > 40
    missing = {
        (script, module, path)
        for script, module, paths in rows
        for path in paths
        if path not in inputs[script, module]
    }
    assert not missing


def test_no_import_waits_until_a_function_is_called():
    """Where a module is imported by a name made at run time, its folder is an input by its name."""
    late = r"import_module\(|__import__|runpy|^ +(from .* )?import "
    files = sorted((ROOT / "src/stronge1994").rglob("*.py"))
    import re

    assert {path.name for path in files if re.search(late, path.read_text("utf-8"), re.M)} == set()
