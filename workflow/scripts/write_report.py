"""Write the run as one page: verdicts, figures, provenance, ledger, tables, interface.

Reads what the run has written and solves nothing. A solver that crashed is a failing row, a picture
and tables that say so.
"""

import base64
import io
import re
from collections import Counter
from pathlib import Path
from types import SimpleNamespace

import api_reference
import csv_tables
import docstring_html
import draw_residuals
import jinja2
import job
import pages
import run_facts
import verdict_table
import write_ledger_page
import yaml

MARKS = {
    "diverges": "fails",
    "differs as documented": "rounding",
    "awaited": "not",
    "agrees": "confirmed",
}
MEANING = {
    "diverges": "outside its tolerance: the run fails",
    "differs as documented": "a known difference, within bounds on both sides",
    "awaited": "the reference is not to be had yet",
    "agrees": "within its tolerance",
}
SHARED = ("mass_ratio", "stiffness_ratio")


def page(verdicts, ledger, figures, tables, sources, run, symbols, links, template):
    """The report.

    Parameters
    ----------
    verdicts, ledger : list of dict
        Rows of results/verdicts.csv and results/ledger.csv.
    figures : dict
        `{name: what figure() gave}`.
    tables : dict
        `{name: {"rows", "caption"}}` of `which_model`, `trade`, `stability`.
    sources : dict
        Contents of data/*/source.yaml.
    run : dict
        `versions`, `system`, `date`, `commit` and `times` of `run_facts`.
    symbols : str
        What stands in the ledger's formulas.
    links : dict
        `{file beside the report: what it is}`.
    template : Path

    Returns
    -------
    str
    """
    names = {row["entry"] for row in ledger}
    reference = api_reference.modules()
    known = api_reference.anchors(reference)

    def docs(text, module):
        link = lambda name: api_reference.target(name, module, reference, known)  # noqa: E731
        return docstring_html.html(text, link)

    environment = pages.environment(Path(template).parent)
    environment.filters |= {
        "maths": write_ledger_page.linked_maths(names),
        "number": number,
        "quantity": draw_residuals.words,
        "docs": docs,
        "sentence": sentence,
    }
    return environment.get_template(Path(template).name).render(
        write_ledger_page.words(ledger, symbols),
        verdicts=verdicts,
        failing=verdict_table.failing(verdicts),
        verdict_counts=Counter(row["verdict"] for row in verdicts),
        marks=MARKS,
        verdict_meaning=MEANING,
        entry_of=_entry_of(names),
        figures=figures,
        functions={name: api_reference.functions_of_figure(reference, name) for name in figures},
        tables=tables,
        sources=sources,
        run=run,
        links=links,
        reference=reference,
    )


def figure(name, svg, caption, residuals, verdicts, config):
    """What the report shows of one figure.

    Parameters
    ----------
    name : str
    svg : bytes
        Its picture.
    caption : str
    residuals : list of dict
        Rows of results/residuals/FIGURE.csv.
    verdicts : list of dict
        Rows of results/verdicts.csv, those of other figures too.
    config : dict
        The config as it was in the run.

    Returns
    -------
    dict
    """
    rows = [row for row in verdicts if row["figure"] == name]
    entries = {c: e for c, e in config["comparisons"].items() if e["figure"] == name}
    words = {row["comparison"]: row["verdict"] for row in rows}
    strips = draw_residuals.draw(residuals, entries, words)
    return {
        "title": title(name),
        "picture": _embedded(svg),
        "caption": caption,
        "alt": re.split(r"\.\s+(?=[A-Z])", caption)[0].rstrip("."),
        "rows": rows,
        "has_residuals": bool(residuals),
        "strips": _embedded(_svg(strips)) if strips else None,
        "config": _yaml(
            {key: config[key] for key in SHARED}
            | {"figures": {name: config["figures"][name]}}
            | ({"comparisons": entries} if entries else {})
        ),
    }


def title(name):
    """Name of a figure for a reader.

    Examples
    --------
    >>> title("fig5"), title("micro_slip")
    ('Fig. 5', 'Micro slip')
    """
    if name.startswith("fig"):
        return f"Fig. {name.removeprefix('fig')}"
    return name.replace("_", " ").capitalize()


def caption(path, name):
    """Caption of a figure or table, from the template that snakemake --report renders."""
    wildcards = SimpleNamespace(figure=name)
    template = jinja2.Template(Path(path).read_text(encoding="utf-8"))
    return template.render(snakemake=SimpleNamespace(wildcards=wildcards)).strip()


def number(text):
    """A cell of a table with three digits at most; words stay.

    Examples
    --------
    >>> number("0.123456"), number("1.56e+03"), number("lumped")
    ('0.123', '1560', 'lumped')
    """
    try:
        return f"{float(f'{float(text):.3g}'):g}"
    except ValueError:
        return text


def sentence(text):
    """A text with a capital letter at its head.

    Examples
    --------
    >>> sentence("it must run")
    'It must run'
    """
    return text[:1].upper() + text[1:]


def _entry_of(names):
    """Entry of the ledger that a row of the verdict table names, or None."""

    def entry_of(row):
        name = row["note"].removeprefix("ledger: ")
        return name if name in names else None

    return entry_of


def _svg(figure):
    file = io.BytesIO()
    figure.savefig(file, format="svg", metadata={"Date": None})
    return file.getvalue()


def _embedded(svg):
    return f"data:image/svg+xml;base64,{base64.b64encode(svg).decode()}"


class _Dumper(yaml.SafeDumper):
    """Without the anchors that two equal entries would get."""

    def ignore_aliases(self, data):
        return True


def _yaml(document):
    style = {"sort_keys": False, "default_flow_style": None, "width": 96, "allow_unicode": True}
    return yaml.dump(document, Dumper=_Dumper, **style)


def write(output, verdicts, ledger, svgs, residuals, captions, tables, config, **parts):
    """Read the tables and pictures of a run and write the report.

    Parameters
    ----------
    output, verdicts, ledger : str
        The report, and both tables.
    svgs, residuals : dict
        `{figure: file}`.
    captions : str
        The template of the figures' captions; those of tables stand beside it.
    tables : dict
        `{name: file}`.
    config : dict
    **parts
        `sources`, `run`, `symbols`, `links`, `template` as for `page`.
    """
    rows = csv_tables.read_rows(verdicts)
    figures = {
        name: figure(
            name,
            Path(svgs[name]).read_bytes(),
            caption(captions, name),
            csv_tables.read_rows(residuals[name]),
            rows,
            config,
        )
        for name in svgs
    }
    tables = {
        name: {
            "rows": csv_tables.read_rows(path),
            "caption": caption(Path(captions).with_name(f"{name}.rst"), name),
        }
        for name, path in tables.items()
    }
    pages.write(output, page(rows, csv_tables.read_rows(ledger), figures, tables, **parts))


if "snakemake" in globals():
    with job.log_to(snakemake.log[0]):  # noqa: F821
        files, given = snakemake.input, snakemake.params  # noqa: F821
        write(
            snakemake.output[0],  # noqa: F821
            files.verdicts,
            files.ledger,
            dict(zip(given.figures, files.pictures, strict=True)),
            dict(zip(given.figures, files.residuals, strict=True)),
            files.captions,
            {Path(path).stem: path for path in files.tables},
            given.config,
            sources=given.sources,
            run={
                "versions": run_facts.versions(),
                "system": run_facts.system(),
                "date": run_facts.date(),
                "commit": run_facts.commit("."),
                "times": run_facts.times("results/benchmarks"),
            },
            symbols=given.symbols,
            links=given.links,
            template=files.template,
        )
