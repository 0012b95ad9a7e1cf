"""Types that users' type checkers see: of arguments, of one impact and of arrays."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import get_args

import pytest

from planarimpact.common import losses
from tests.unit import typed_client

SRC = Path(__file__).parents[2] / "src"
CLIENT = Path(typed_client.__file__)
WRONG = {
    number
    for number, line in enumerate(CLIENT.read_text().splitlines(), 1)
    if line.endswith("# wrong")
}


@pytest.mark.parametrize("names, table", [
    (losses.LumpedLoss, losses.LUMPED),
    (losses.NoncollinearLoss, losses.NONCOLLINEAR),
    (losses.SpheresLoss, losses.SPHERES),
])  # fmt: skip
def test_a_type_names_the_losses_of_its_table(names, table):
    assert get_args(names) == tuple(table)


@pytest.mark.parametrize(
    "use", [typed_client.scalars, typed_client.arrays, typed_client.bodies_in_space]
)
def test_the_client_runs(use):
    use()


@pytest.mark.slow
def test_mypy_refuses_the_wrong_lines_alone(tmp_path):
    # As a user's mypy sees an installed package: without the settings of this repository.
    flags = "--strict", "--config-file=", "--follow-imports=silent", f"--cache-dir={tmp_path}"
    command = [sys.executable, "-m", "mypy", *flags, "--no-error-summary", str(CLIENT)]
    paths = {"MYPYPATH": str(SRC)}
    done = subprocess.run(command, capture_output=True, text=True, env=os.environ | paths)
    lines = [line for line in done.stdout.splitlines() if ": error:" in line]
    assert {int(line.split(":")[1]) for line in lines} == WRONG, done.stdout + done.stderr


@pytest.mark.slow
def test_pyright_refuses_the_wrong_lines_alone(tmp_path):
    found = shutil.which("pyright")
    if found is None:
        pytest.skip("pyright is not installed")
    shutil.copy(CLIENT, tmp_path)
    config = tmp_path / "pyrightconfig.json"
    config.write_text(json.dumps({"strict": ["."], "extraPaths": [str(SRC)]}))
    command = [found, "--outputjson", f"--pythonpath={sys.executable}", "-p", str(config)]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode not in (0, 1):
        pytest.skip(f"pyright does not run here: {done.stderr[-200:]}")
    said = json.loads(done.stdout)["generalDiagnostics"]
    lines = {one["range"]["start"]["line"] + 1 for one in said if one["severity"] == "error"}
    assert lines == WRONG, done.stdout
