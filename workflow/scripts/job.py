"""The jobs of a run: a function for each rule, by its name. What a job prints goes to its log."""

import sys
from pathlib import Path

sys.stdout = sys.stderr = open(snakemake.log[0], "w", encoding="utf-8")  # noqa: SIM115  (until it ends)
given, made, asked, wildcards = (
    snakemake.input, snakemake.output, snakemake.params, snakemake.wildcards,
)  # fmt: skip


def job():
    sys.exit("job is no target: it has what other rules share. Targets: workflow/README.md")


def curves():
    from stronge1994 import solving

    solving.solve(wildcards.figure, **asked.settings, output=made[0])


def scene():
    from planarimpact import scene

    report = scene.solve_file(given.table, made[0], asked.tolerance)
    print(report.explain())  # which model took how many impacts, and why


def draw():
    from stronge1994 import versions
    from stronge1994.figures.shared import drawing

    pictures, source = dict(made.items()), versions.source()
    drawing.draw(wildcards.figure, asked.settings, given.curves, pictures, source)


def judge():
    from stronge1994 import judging

    rows = judging.compare(wildcards.judged, given.table, **asked.settings)
    judging.write(rows, made.verdicts, made.residuals)


def verdicts():
    from stronge1994 import figure_table, tables, verdict_table

    rows = verdict_table.gather(given.tables)
    tables.write_rows(made.table, rows, verdict_table.COLUMNS)
    by_figure = figure_table.of_run(rows, asked.shows, asked.grades)
    Path(made.by_figure).write_text(f"{figure_table.text(by_figure)}\n", "utf-8")


def check_ledger():
    from stronge1994 import ledger_table, paper, reference_data, tables
    from stronge1994.paper import checking

    facts = reference_data.load_yaml(given.facts)["facts"]
    rows = checking.check(paper.entries(facts).values())
    tables.write_rows(made[0], rows, ledger_table.COLUMNS)
    print(ledger_table.summary(rows))


def accept():
    from stronge1994 import accepted, ledger_table, tables, verdict_table

    ledger = tables.read_rows(given.ledger, ledger_table.COLUMNS)
    accepted.write(verdict_table.gather(given.verdicts), ledger)


def gate():
    from stronge1994 import accepted, gate, ledger_table, tables, verdict_table

    rows = verdict_table.gather(given.verdicts)
    ledger = tables.read_rows(given.ledger, ledger_table.COLUMNS) if asked.entries else []
    known = accepted.read(given.accepted)
    faults = gate.faults(rows, ledger, asked.rows, asked.entries, known)
    new = accepted.new(rows, known)
    told = gate.summary(rows, ledger, faults, asked.shows, asked.grades, new)
    print(told)
    if faults or gate.unmade(rows):
        sys.exit(1)
    Path(made[0]).write_text(told, encoding="utf-8")


def report():
    from stronge1994.pages import report

    report.write(given, made, **asked.settings)


def lecture():
    from stronge1994.pages import lectures

    lectures.run(given.notebook, {"page": given.page, "slides": given.slides}, made)


def explorer():
    from stronge1994 import versions
    from stronge1994.explorer import page
    from stronge1994.explorer.answers import answers
    from stronge1994.pages import templates

    text = page.page(asked.settings, given.sources, answers(page.LIMITS))
    Path(made.page).write_text(text, encoding="utf-8")
    start = templates.environment().get_template("index.html")
    Path(made.start).write_text(start.render(wheel=versions.WHEEL), encoding="utf-8")


def your_copy():
    from stronge1994.pages import your_copy

    text = your_copy.page(given.sources, given.curves, **asked.settings)
    Path(made.page).write_text(text, encoding="utf-8")


def wheel():
    """Built in a copy of its files: the same bytes from the same files."""
    import contextlib
    import os
    import shutil
    import tempfile

    from setuptools import build_meta

    os.umask(0o022)  # the wheel has the rights of its files
    os.environ["SOURCE_DATE_EPOCH"] = "0"  # and their dates
    folder = Path(made[0]).parent.resolve()
    with tempfile.TemporaryDirectory() as copy:
        for path in given.source:
            Path(copy, path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, Path(copy, path))
        with contextlib.chdir(copy):
            build_meta.build_wheel(folder)


def lite():
    """Built by JupyterLite."""
    import importlib.util
    import json
    import re
    import shutil
    import subprocess
    import tempfile
    import zipfile
    from importlib import metadata

    if not importlib.util.find_spec("jupyterlite_pyodide_kernel"):
        sys.exit(
            "JupyterLite is missing: .venv/bin/python -m pip install -r workflow/envs/lite.txt"
        )
    with tempfile.TemporaryDirectory() as folder:
        files, wheels = Path(folder, "files"), Path(folder, "pypi")
        for path in (files, wheels):
            path.mkdir()
        for path in given.files:
            shutil.copy(path, files)
        # Pyodide lacks this package, which its kernel needs: else that asks the network for it.
        comm = metadata.distribution("comm")
        with zipfile.ZipFile(wheels / f"comm-{comm.version}-py3-none-any.whl", "w") as wheel:
            for path in comm.files:
                if path.suffix != ".pyc":
                    wheel.write(path.locate(), path)
        # What the first cells would install is loaded as the kernel starts, by a path that its
        # script sees: a cell could not read a file of the site if the address is http, not https.
        texts = [path.read_text(encoding="utf-8") for path in files.glob("*.ipynb")]
        lines = re.findall(r'%pip install -q \./(\S+) (.*?)\\n"', "\n".join(texts))
        packages = {f"../../../../files/{wheel}" for wheel, _ in lines}
        packages |= {name for _, names in lines for name in names.split()}
        kernel = {"loadPyodideOptions": {"packages": sorted(packages)}}
        if asked.pyodide_url:
            kernel["pyodideUrl"] = asked.pyodide_url
        settings = {"litePluginSettings": {"@jupyterlite/pyodide-kernel-extension:kernel": kernel}}
        config = {"jupyter-lite-schema-version": 0, "jupyter-config-data": settings}
        Path(folder, "jupyter-lite.json").write_text(json.dumps(config), encoding="utf-8")
        options = ["--lite-dir", folder, "--contents", str(files), "--output-dir"]
        options += [str(Path(made[0]).resolve()), "--apps", "lab", "--apps", "notebooks"]
        options += ["--no-sourcemaps", "--no-unused-shared-packages"]
        command = [sys.executable, "-m", "jupyterlite_core", "build", *options]
        subprocess.run(command, cwd=folder, check=True, stdout=sys.stdout, stderr=sys.stdout)


draw_with_slide, gate_of_target = draw, gate
globals()[snakemake.rule]()
