"""What the README says is so."""

import re
import shlex
import subprocess
import sys
from collections import Counter
from pathlib import Path

import numpy as np

from planarimpact import continuum, lumped
from stronge1994 import csv_tables

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def blocks(language):
    return re.findall(rf"```{language}\n(.*?)```", README, flags=re.S)


def test_python_example_runs_as_printed():
    names = {}
    exec(compile(blocks("python")[0], "README.md", "exec"), names)
    assert [names["Regime"](code).name for code in names["result"].regime] == [
        "STICK_SLIP",
        "SLIP_STICK_SLIP",
        "SLIP_THROUGHOUT",
    ]


def test_continuum_example_runs_as_printed():
    names = {}
    exec(compile(blocks("python")[1], "README.md", "exec"), names)
    assert list(names["result"].reversals) == [1, 1, 0]


def test_ladder_example_runs_as_printed():
    names = {}
    exec(compile(blocks("python")[2], "README.md", "exec"), names)
    assert max(names["ball"].error_bound) <= 1e-10


def test_noncollinear_example_gives_what_it_says():
    names, block = {}, blocks("python")[3]
    exec(compile(block, "README.md", "exec"), names)
    tangential, normal, jams = re.search(r"m/s: (\S+), (\S+), (\w+)", block).groups()
    result = names["result"]
    assert (f"{result.tangential:.2f}", f"{result.normal:.2f}") == (tangential, normal)
    assert str(result.jams) == jams


def test_commands_run_as_printed(tmp_path):
    shown = [
        line for block in blocks("sh") for line in block.splitlines() if "-m planarimpact" in line
    ]
    assert len(shown) == 4
    (tmp_path / "data").symlink_to(ROOT / "data")
    for line in shown:
        command = [sys.executable, *shlex.split(line)[1:]]
        result = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
        assert result.returncode == 0 and result.stdout, (line, result.stderr)


def test_errors_of_the_models_are_as_printed(first_run):
    """To two digits, down to what rounding and the reference leave."""
    table = csv_tables.read_rows(first_run[0] / "results/trade.csv")
    found = {row["name"]: float(row["max_velocity [mu v2(0)]"]) for row in table}
    rows = re.findall(r"^\| (.*) \| ([\d.e-]+) \| ([\d.e-]+) \| .* \| .* \|$", README, flags=re.M)
    rows = [row for row in rows if row[0].replace("`", "") + ", e = 1" in found]
    assert len(rows) == 11
    for name, *errors in rows:
        for e, error in zip(("1", "0.5"), errors, strict=True):
            if error != "-":
                exact = found[f"{name.replace('`', '')}, e = {e}"]
                assert abs(exact - float(error)) <= max(0.06 * exact, 1e-7), (name, e, exact)


def test_paths_and_sources_named_exist():
    named = re.findall(r"`((?:data|workflow|src|tests|figures)/[\w./]+)`", README)
    named += re.findall(r"\]\(((?!http|#)[^)]+)\)", README)
    built = re.compile(r"figures/(?!README|preview)|[.]wpd[.]csv$")
    missing = [p for p in named if not built.search(p) and not (ROOT / p).exists()]
    assert named and not missing
    sources = {path.parent.name for path in (ROOT / "data").glob("*/source.yaml")}
    assert all(f"`{source}`" in README for source in sources)


def test_distance_of_lumped_model_and_continuum_is_as_printed():
    rows = re.findall(
        r"^\| .* \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \|$", README, flags=re.M
    )
    assert len(rows) == 4
    for column, zeta2 in ((0, 17 / 14), (2, 1.5)):
        edges = [0.0, zeta2, 3.5, 7 - zeta2, 10.0]
        for row, low, high in zip(rows, edges, edges[1:], strict=False):
            x = np.linspace(low, high, 500)
            exact = continuum.rebound(x, 3.5, zeta2, tolerance=1e-5).velocity
            gap = lumped.rebound(x, 3.5, zeta2).velocity - exact
            found = np.sqrt(np.mean(gap**2)), np.max(np.abs(gap))
            assert [f"{g:.3f}" for g in found] == [f"{float(c):.3f}" for c in row[column:][:2]]


def test_stability_is_as_printed(first_run):
    impacts = csv_tables.read(first_run[0] / "results/curves/stability.csv")["impacts"]
    section = README.split("## How stable is it?")[1].split("##")[0]
    count, phases, lost = (
        int(re.search(words, section)[1])
        for words in (r"(\d+) impacts", r"(\d+) phases", r"more than (\d+) digit")
    )
    assert count == impacts["phases [1]"].size
    assert phases == round(impacts["phases [1]"].max(), -2)
    assert lost - 1 < impacts["digits_lost [1]"].max() <= lost


def test_documented_differences_are_counted(first_run):
    rows = csv_tables.read_rows(first_run[0] / "results/verdicts.csv")
    count = sum(row["verdict"] == "differs as documented" for row in rows)
    assert {16: "Sixteen"}[count] + " rows differ as documented" in README


def test_ledger_is_counted(first_run):
    rows = csv_tables.read_rows(first_run[0] / "results/ledger.csv")
    count = Counter(row["verdict"] for row in rows)
    assert (
        f"Of {len(rows)} entries {count['confirmed']} are confirmed, "
        f"{count['confirmed within rounding']} confirmed within rounding, {count['wrong']} wrong, "
        f"{count['not testable']} not testable here"
    ) in " ".join(README.split())
