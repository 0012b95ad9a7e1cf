"""A run that passes has passed: what is broken, cut, killed or planted never ends in PASSED."""

import os
import re
import shutil
import signal
import subprocess
import sys
import time

import pytest

from stronge1994.gate import options
from stronge1994.plan import config as configuration
from stronge1994.plan import files

# At the first start of a job it is killed without warning, later it fails.
FAULT = """
if "snakemake" in globals():
    import os, pathlib, signal

    mark = pathlib.Path("killed", pathlib.Path(snakemake.log[0]).stem)
    if not mark.exists():
        mark.parent.mkdir(exist_ok=True)
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    raise RuntimeError("broken on purpose")
"""
# Every rule by the script of its jobs, in the order of the data. Those above others hide these.
BEFORE, BEHIND = "before its work", "behind its work"
LAYERS = [
    {
        "curves": ("solve", BEFORE),
        "series": ("convert_series", BEHIND),
        "ledger": ("check_ledger", BEFORE),
        "scene": ("solve_scene", BEFORE),
        "solve_chunk": ("solve_chunk", BEHIND),
        "explorer": ("write_explorer", BEHIND),
        "notebook": ("run_notebook", BEFORE),
    },
    {
        "draw": ("draw", BEFORE),
        "compare": ("compare", BEHIND),
        "sensitivity": ("sensitivity", BEHIND),
        "trade": ("write_trade", BEHIND),
        "stability": ("write_stability", BEHIND),
        "gather_chunks": ("gather_chunks", BEHIND),
        "ledger_page": ("write_ledger_page", BEHIND),
    },
    {
        "verdicts": ("gather_verdicts", BEHIND),
        "gates": ("gather_gates", BEHIND),
        "draw_study": ("draw_study", BEHIND),
    },
    {"report": ("write_report", BEHIND)},
    {"gate": ("gate", BEFORE)},
]


def refuses_to_pass(project, *arguments):
    """Run, and check that nothing says PASSED; what was printed."""
    result = project.run(*arguments)
    assert result.returncode != 0, result.stdout
    assert "PASSED." not in result.stdout
    assert not (project / "results/PASSED").exists()
    return result.stdout


def test_layers_name_every_rule(fresh):
    words = "".join(file.read_text() for file in (fresh / "workflow/rules").glob("*.smk"))
    rules = set(re.findall(r"^rule (\w+):", words, flags=re.M)) - {"measure_peers", "draw_peers"}
    assert rules == {rule for layer in LAYERS for rule in layer}


@pytest.mark.parametrize("layer", LAYERS, ids=["-".join(layer) for layer in LAYERS])
def test_a_job_that_is_killed_and_then_fails_never_passes(finished, layer):
    """In a tree that has passed: the same command again does not go on with what is left over."""
    for script, place in layer.values():
        path = finished / f"workflow/scripts/{script}.py"
        text = path.read_text()
        path.write_text(FAULT + text if place == BEFORE else text + FAULT)
    for _ in range(2):
        said = refuses_to_pass(finished)
        assert set(layer) == set(re.findall(r"^Error in rule (\w+):", said, flags=re.M))
    assert "broken on purpose" in said and "A job stopped" in said or "FAILED" in said


def test_a_killed_job_does_not_hide_a_divergence(finished):
    """Half the points are gone, and the job that would say so is killed once."""
    path = finished / "data/chung_ooi2011/spin.csv"
    lines = path.read_text().splitlines()
    halves = [f"{x},{float(y) / 2}" for x, y in (line.split(",") for line in lines[1:])]
    path.write_text("\n".join([lines[0], *halves]) + "\n")
    script = finished / "workflow/scripts/compare.py"
    script.write_text(
        script.read_text() + FAULT.replace('raise RuntimeError("broken on purpose")', "")
    )
    refuses_to_pass(finished)
    assert "diverges: fig5-lumped-fem-spin" in refuses_to_pass(finished)


BROKEN = [
    ("workflow/scripts/draw_fig6.py", "def broken(:\n", "draw_fig6.py, line 1: invalid syntax"),
    ("src/planarimpact/curves/fig7.py", "return 1\n", "fig7.py, line 1: 'return' outside function"),
    ("workflow/scripts/solve.py", "x = '\0'\n", "scripts/solve.py"),
    ("workflow/scripts/solve.py", b"x = '\xff'\n", "scripts/solve.py"),
    ("src/planarimpact/noncollinear/rigid.py", "if:\n", "noncollinear/rigid.py, line 1"),
]


@pytest.mark.parametrize(("path", "text", "words"), BROKEN)
def test_a_module_that_is_no_python_is_refused(copied_modules, path, text, words):
    files.refuse_unreadable_modules()
    (copied_modules / path).write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(configuration.ConfigError, match=re.escape(words)):
        files.refuse_unreadable_modules()


@pytest.mark.parametrize(
    "text",
    ["{", '{"cells": 1}', '{"cells": [{"cell_type": "code", "source": ["def"]}]}', "[" * 9999],
)
def test_a_notebook_that_is_none_is_refused(copied_modules, text):
    (copied_modules / "workflow/notebooks/choosing_a_model.ipynb").write_text(text)
    with pytest.raises(configuration.ConfigError, match=r"notebooks/choosing_a_model\.ipynb"):
        files.modules_of_notebook("choosing_a_model")


@pytest.mark.parametrize(
    ("text", "words"),
    [("", "empty"), (" \n", "empty"), ("a\n<<<<<<< HEAD\nb\n", "merge"), (None, "missing")],
)
def test_a_source_that_is_lost_or_half_merged_is_refused(tmp_path, text, words):
    path = tmp_path / "page.js"
    path.write_text("let x = 1 << 7;\n")
    assert files.present(path) == path
    path.unlink() if text is None else path.write_text(text)
    with pytest.raises(configuration.ConfigError, match=f"page.js: .*{words}"):
        files.present(path)


def test_a_finished_tree_with_a_broken_module_or_a_lost_source_is_refused(finished):
    """Snakemake alone would drop the rule and end with "Nothing to be done"."""
    path = finished / "workflow/scripts/draw_fig6.py"
    whole = path.read_text()
    path.write_text(whole + "def broken(:\n")
    said = finished.run()
    assert said.returncode != 0 and "draw_fig6.py, line" in said.stdout
    path.write_text(whole)
    (finished / "workflow/report/page.css").unlink()
    said = finished.run()
    assert said.returncode != 0 and "page.css: missing" in said.stdout


def test_short_tables_do_not_pass_twice_in_a_row(finished):
    """End to end, with what `judged` tries in one process."""
    short = ("results/stability.csv", "results/verdicts/fig8.csv")
    for path in short:
        (finished / path).write_text((finished / path).read_text().split("\n")[0] + "\n")
    for _ in range(2):
        assert "remove that file and run again" in refuses_to_pass(finished)
    for path in short:
        (finished / path).unlink()
    mended = finished.run()
    assert mended.returncode == 0 and "PASSED." in mended.stdout, mended.stdout


def test_passed_does_not_outlive_what_it_was_about(finished):
    passed = finished / "results/PASSED"
    assert finished.run("figures/fig6.svg", "--config", "stiffness_ratio=1.5").returncode == 0
    assert not passed.exists()
    assert finished.run().returncode == 0 and passed.exists()

    # Killed behind the verdicts, before the gate.
    (finished / "results/verdicts.csv").unlink()
    command = [sys.executable, "-m", "snakemake", "--cores", "2"]
    with open(finished / "words.txt", "w") as words:
        running = subprocess.Popen(
            command, cwd=finished.folder, stdout=words, stderr=words, start_new_session=True
        )
        while passed.exists() and running.poll() is None:
            time.sleep(0.02)
        os.killpg(running.pid, signal.SIGKILL)
        running.wait()
    assert not passed.exists()
    assert finished.run("--unlock").returncode == 0

    passed.write_text("")
    again = finished.run()
    assert again.returncode == 0 and "PASSED." in again.stdout
    assert "every entry of the ledger holds" in passed.read_text()


def test_results_without_records_are_refused(finished, first_run):
    """A copy of a folder may leave hidden files out: then no change of physics would be noticed."""
    shutil.rmtree(finished / ".snakemake")
    metadata = shutil.copytree(first_run[0] / ".snakemake/metadata", finished / "metadata")
    for path in metadata.iterdir():
        path.write_bytes(path.read_bytes()[:100])
    for kept in (None, "metadata", "records"):
        if kept == "metadata":
            shutil.copytree(metadata, finished / ".snakemake/metadata")
        elif kept:
            shutil.copytree(first_run[0] / ".snakemake/records", finished / ".snakemake/records")
        assert "how it was made is not known" in refuses_to_pass(
            finished, "--config", "stiffness_ratio=1.5"
        )


def test_other_files_of_an_older_date_are_noticed(finished):
    """As an archive or a backup leaves them."""
    for path in ("src/planarimpact/laws.py", "data/kharaz2001/spin.csv"):
        text = (finished / path).read_text()
        for old, new in {"import numpy": "import  numpy", "kratos,69.96": "kratos,69.97"}.items():
            text = text.replace(old, new)
        (finished / path).write_text(text)
        os.utime(finished / path, (0, 0))
    jobs = finished.planned()[0]
    assert {"Solving trade", "Verifying the paper", "Reading the series of kharaz2001"} <= set(jobs)


def test_what_is_gone_is_made_again(finished):
    """Also where nothing else has changed, and everything had passed."""
    gone = ("figures/fig5.png", "figures/report.html", "results/curves/fig2.csv")
    gone += ("results/series/kharaz2001.csv", "results/residuals/fig3.csv", "results/study.npz")
    for path in gone:
        (finished / path).unlink()
    again = finished.run()
    assert again.returncode == 0 and "PASSED." in again.stdout, again.stdout
    assert all((finished / path).exists() for path in gone)


def test_results_of_other_physics_that_come_back_do_not_pass(finished, tmp_path):
    """Restored from a backup, while config and records are those of the last run."""
    backup = shutil.copytree(finished / "results", tmp_path / "backup")
    wrong = ["--config", "figures={fig6: {restitution: [0, 0.6, 1]}}"]
    refuses_to_pass(finished, *wrong)
    shutil.rmtree(finished / "results")
    shutil.copytree(backup, finished / "results")
    for _ in range(2):
        refuses_to_pass(finished, *wrong)


def test_a_refused_run_has_not_passed(finished):
    passed = finished / "results/PASSED"
    true = passed.read_text()
    for words in ("--config mass_ratio=-1", "--touch"):
        passed.write_text(true)
        refuses_to_pass(finished, *words.split())


def test_a_dry_run_changes_nothing(finished):
    passed = (finished / "results/PASSED").read_text()
    assert finished.planned("--config", "stiffness_ratio=1.5")[0]
    assert (finished / "results/PASSED").read_text() == passed


# In tests of a process each takes a second: here as `snakemake` reads them.
UNTRUSTWORTHY = [
    "--keep-incomplete", "--touch", "-t", "--no-hook", "--ignore-incomplete", "--ii", "--nolock",
    "--allowed-rules all gate --", "--rerun-triggers mtime", "--rerun-t input code",
    "--drop-metadata",
]  # fmt: skip


@pytest.mark.parametrize("words", UNTRUSTWORTHY)
def test_options_that_would_make_passed_untrue_are_refused(words, fresh, monkeypatch):
    monkeypatch.chdir(fresh.folder)
    with pytest.raises(options.OptionError, match="not allowed here"):
        options.refuse_untrustworthy(["snakemake", "--cores", "2", *words.split()])


def test_other_options_are_not_refused(fresh, monkeypatch):
    monkeypatch.chdir(fresh.folder)
    for words in ("", "-n", "figures --config a=1", "-F", "--until compare", "-j 1 study"):
        options.refuse_untrustworthy(["/bin/snakemake", "--cores", "2", *words.split()])
    assert options.is_dry(["snakemake", "-n"]) and not options.is_dry(["snakemake", "-F"])


def test_a_profile_does_not_hide_what_is_not_allowed(fresh, monkeypatch):
    monkeypatch.chdir(fresh.folder)
    with open("profiles/default/config.yaml", "a") as file:
        file.write("rerun-triggers: [mtime]\n")
    for arguments in (["snakemake", "--cores", "2"], ["/bin/smk", "--cores", "2"]):
        with pytest.raises(options.OptionError, match="--rerun-triggers"):
            options.refuse_untrustworthy(arguments)
    with pytest.raises(options.OptionError, match="own command line"):
        options.refuse_untrustworthy(["another program", "--what"])


def test_bytecode_of_other_sources_is_not_run(finished):
    """A source of the same size and date as the one before, as an archive may leave it."""
    path = finished / "src/planarimpact/lumped.py"
    right = path.read_text()
    wrong = right.replace("shaped(x, velocity, peak", "shaped(x,-velocity, peak")
    assert wrong != right and len(wrong) == len(right)
    os.utime(path, (1e9, 1e9))
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    environment["PYTHONPATH"] = str(finished / "src")
    command = [sys.executable, "-c", "import planarimpact.lumped"]
    subprocess.run(command, env=environment, check=True)
    assert list(path.parent.rglob("__pycache__/lumped*.pyc"))
    path.write_text(wrong)
    os.utime(path, (1e9, 1e9))
    table = finished / "results/curves/fig6.csv"
    before = table.read_text()
    assert finished.run("results/curves/fig6.csv").returncode == 0
    assert table.read_text() != before


def test_another_snakefile_than_that_of_the_folder_is_refused(finished, first_run):
    said = finished.run("-s", str(first_run[0] / "Snakefile"))
    assert said.returncode != 0 and "in the folder of its Snakefile" in said.stdout


def test_words_of_vanished_jobs_and_chunks_are_gone(finished):
    for path in ("results/benchmarks/curves_fig99.tsv", "results/study/0-7.npz"):
        (finished / path).write_text("old")
    few = "study={chunks: 2, grid: {incidence: {points: 20}}}"
    assert finished.run("study", "--config", few).returncode == 0
    assert not (finished / "results/benchmarks/curves_fig99.tsv").exists()
    names = sorted(path.name for path in (finished / "results/study").iterdir())
    assert names == ["0-4020.npz", "4020-8040.npz"]
    # What jobs said about the chunks of the old grid goes with them.
    left = {path.name for path in (finished / "results/benchmarks").glob("study_*")}
    assert left == {"study_0-4020.tsv", "study_4020-8040.tsv"}
