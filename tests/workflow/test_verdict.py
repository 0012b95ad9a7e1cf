"""A run that passes has passed: what is broken, cut, killed or planted never ends in PASSED."""

import csv
import os
import re
import shutil
import sys
from types import SimpleNamespace

import pytest
from conftest import ROOT
from snakemake.exceptions import WorkflowError

from stronge1994 import gate, records
from stronge1994.gate import options
from stronge1994.plan import config as configuration
from stronge1994.plan import files


def test_a_divergence_fails_until_it_is_mended(finished, tmp_path):
    """Wrong physics, a solver that crashes; the same again; old results; a picture that is cut."""
    backup = shutil.copytree(finished / "results", tmp_path / "backup")
    wrong = "figures={fig6: {restitution: [0, 0.6, 1]}}"
    solver = (finished / "src/stronge1994/curves/fig7.py").read_text()
    broken = solver.replace("    named = {", "    raise ArithmeticError('oh')\n    {")
    assert broken != solver
    (finished / "src/stronge1994/curves/fig7.py").write_text(broken)
    said = finished.refuses_to_pass("--config", wrong)
    with open(finished / "results/verdicts.csv", newline="") as file:
        found = {row["comparison"]: row["verdict"] for row in csv.DictReader(file)}
    bad = {name for name, verdict in found.items() if verdict == "diverges"}
    assert bad >= {name for name in found if name.startswith("fig7")}
    assert "fig6-rebound" in bad
    assert {name.partition("-")[0] for name in bad} == {"fig6", "fig7"}
    names = configuration.load(ROOT)["figures"]
    assert all((finished / f"figures/{name}.png").exists() for name in names)
    assert 'class="result bad"' in (finished / "figures/report.html").read_text()
    # Worst first; and the last words say which rows, and how to have the same without being judged.
    table = said[said.index("verdict  ") :].splitlines()
    assert table[2].startswith("diverges") and "no curves: ArithmeticError: oh" in said
    failed = next(i for i, line in enumerate(table) if line.startswith("FAILED. Reasons: "))
    assert table[failed + 1].startswith("  diverges: fig") and len(table) - failed < 16
    assert f"snakemake --cores 2 figures --config '{wrong}'" in table[failed - 1]

    shutil.rmtree(finished / "results")
    shutil.copytree(backup, finished / "results")
    finished.refuses_to_pass("--config", wrong)
    again = finished.refuses_to_pass("--config", wrong)
    assert "FAILED. Reasons: " in again and "Drawing" not in again

    (finished / "src/stronge1994/curves/fig7.py").write_text(solver)
    cut = finished / "figures/fig8.png"
    cut.write_bytes(cut.read_bytes()[:999])
    said = finished.refuses_to_pass()
    assert "figures/fig8.png: not whole" in said and "remove that file and run again" in said
    cut.unlink()
    finished.passes()


BROKEN = [
    ("src/stronge1994/drawings/fig6.py", "def broken(:\n", "fig6.py, line 1: invalid syntax"),
    ("src/stronge1994/curves/fig7.py", "return 1\n", "fig7.py, line 1: 'return' outside function"),
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


@pytest.fixture
def start(copied_modules, monkeypatch):
    """What a start of Snakemake does first, in this process: workflow/rules/start.smk."""
    for part in ("profiles", "data"):
        shutil.copytree(ROOT / part, copied_modules / part)
    monkeypatch.chdir(copied_modules)
    monkeypatch.setattr(sys, "path", list(sys.path))
    monkeypatch.setenv("PYTHONPATH", "")

    def started(*arguments, folder=copied_modules, files=(), config=()):
        monkeypatch.setattr(sys, "argv", ["snakemake", "--cores", "2", *arguments])
        settings = SimpleNamespace(configfiles=files, config_args=config)
        workflow = SimpleNamespace(
            basedir=str(folder), is_main_process=True, config_settings=settings
        )
        text = (copied_modules / "workflow/rules/start.smk").read_text()
        exec(compile(text, "start.smk", "exec"), {"workflow": workflow})

    return started


def _twice(folder):
    (folder / "twice.yaml").write_text("a: 1\na: 2\n")
    return {"files": ["twice.yaml"]}


def _no_python(folder):
    (folder / "src/planarimpact/rigid.py").write_text("x = = 2\n")
    return {}


def _braces(folder):
    (folder / "{x}").symlink_to(folder)
    return {"folder": folder / "{x}"}


REFUSED = {
    "/{x}: Snakemake takes braces in a path for a wildcard": _braces,
    "--consider-ancient: not allowed here": lambda _: {
        "arguments": ["--consider-ancient", "curves=modules"]
    },
    "run Snakemake in the folder of its Snakefile": lambda folder: {"folder": folder.parent},
    "rigid.py, line 1: invalid syntax": _no_python,
    "the key 'a' stands twice": _twice,
    "--config a=0x10": lambda _: {"config": ["a=0x10"]},
    "--touch: not allowed here": lambda _: {"arguments": ["--touch"]},
}


@pytest.mark.parametrize("words", REFUSED)
def test_a_start_that_is_refused_has_not_passed(words, start, copied_modules):
    passed = copied_modules / "results/PASSED"
    passed.parent.mkdir()
    passed.write_text("passed")
    start()
    assert passed.exists()
    given = REFUSED[words](copied_modules)
    with pytest.raises(WorkflowError, match=re.escape(words)):
        start(*given.pop("arguments", ()), **given)
    assert passed.exists() == ("folder" in given)  # that of another folder is not ours


@pytest.mark.parametrize("kept", [None, "metadata", "records"])
def test_results_without_records_are_refused(first_run, tmp_path, monkeypatch, kept):
    """A copy of a folder may leave hidden files out: then no change of physics would be noticed."""
    project = first_run[0]
    shutil.copytree(project / "results", tmp_path / "results")
    made = [path for path in project.records() if path.startswith("results/curves")]
    monkeypatch.chdir(tmp_path)
    if kept:
        shutil.copytree(project / ".snakemake" / kept, tmp_path / ".snakemake" / kept)
    with pytest.raises(RuntimeError, match="how it was made is not known"):
        gate.refuse_unknown_results(made)
    for folder in ("metadata", "records"):
        source, copy = project / ".snakemake" / folder, tmp_path / ".snakemake" / folder
        shutil.copytree(source, copy, dirs_exist_ok=True)
    gate.refuse_unknown_results(made)
    for path in filter(os.path.isfile, records.METADATA.rglob("*")):
        path.write_bytes(path.read_bytes()[:100])
    with pytest.raises(RuntimeError, match="how it was made is not known"):
        gate.refuse_unknown_results(made)


def test_a_start_refuses_results_without_records(fresh):
    (fresh / "results/curves").mkdir(parents=True)
    (fresh / "results/curves/fig6.csv").write_text("curve\n")
    (fresh / "results/PASSED").write_text("")
    assert "fig6.csv: there, but how it was made is not known" in fresh.refuses_to_pass()


# In tests of a process each takes a second: here as `snakemake` reads them.
UNTRUSTWORTHY = [
    "--keep-incomplete", "--touch", "-t", "--no-hook", "--ignore-incomplete", "--ii", "--nolock",
    "--allowed-rules all gate --", "--rerun-triggers mtime", "--rerun-t input code",
    "--drop-metadata", "--consider-ancient gate=9",
]  # fmt: skip


@pytest.mark.parametrize("words", UNTRUSTWORTHY)
def test_options_that_would_make_passed_untrue_are_refused(words, monkeypatch):
    monkeypatch.chdir(ROOT)
    with pytest.raises(options.OptionError, match="not allowed here"):
        options.refuse_untrustworthy(["snakemake", "--cores", "2", *words.split()])


def test_other_options_are_not_refused(monkeypatch):
    monkeypatch.chdir(ROOT)
    for words in ("", "-n", "figures --config a=1", "-F", "--until compare", "-j 1 study"):
        options.refuse_untrustworthy(["/bin/snakemake", "--cores", "2", *words.split()])
    assert options.is_dry(["snakemake", "-n"]) and not options.is_dry(["snakemake", "-F"])


def test_a_profile_does_not_hide_what_is_not_allowed(tmp_path, monkeypatch):
    shutil.copytree(ROOT / "profiles", tmp_path / "profiles")
    (tmp_path / "Snakefile").touch()
    monkeypatch.chdir(tmp_path)
    with open("profiles/default/config.yaml", "a") as file:
        file.write("rerun-triggers: [mtime]\n")
    for arguments in (["snakemake", "--cores", "2"], ["/bin/smk", "--cores", "2"]):
        with pytest.raises(options.OptionError, match="--rerun-triggers"):
            options.refuse_untrustworthy(arguments)
    with pytest.raises(options.OptionError, match="own command line"):
        options.refuse_untrustworthy(["another program", "--what"])


def test_words_and_chunks_of_another_number_of_chunks_are_gone(finished):
    few = "study={chunks: 2, grid: {incidence: {points: 20}}}"
    assert finished.run("study", "--config", few).returncode == 0
    made = {path for path, r in finished.records().items() if r["rule"] == "solve_chunk"}
    left = sorted(path.stem for path in (finished / "results/study").iterdir())
    assert left == ["1-of-2", "2-of-2"]
    assert {f"results/study/{chunk}.npz" for chunk in left} <= made
    for folder in ("benchmarks", "logs"):
        words = {path.stem for path in (finished / "results" / folder).glob("study_*")}
        assert words == {f"study_{chunk}" for chunk in left}
