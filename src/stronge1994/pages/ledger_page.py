"""Write the ledger's table as a page to read: one HTML file that needs no other file."""

import re
from collections import Counter
from collections.abc import Callable, Collection, Mapping, Sequence
from pathlib import Path
from typing import Any

from markupsafe import Markup

from stronge1994 import words
from stronge1994.formulas import mathematical
from stronge1994.ledger import finding, outcome
from stronge1994.pages import templates
from stronge1994.tables import Row

# Classes of the style, by verdict, by grade, and by verdict in nature.
STYLE = {
    "confirmed": "confirmed",
    "confirmed within rounding": "rounding",
    "wrong": "wrong",
    "not testable": "not",
}
GRADE_STYLE = dict(zip(outcome.GRADES, ("grave", "misprint", "judgement"), strict=True))
NATURE_STYLE = {
    finding.STANDS: "nature stands",
    finding.FAILS: "nature contradicted",
    finding.DEPENDS: "nature depends",
    finding.OPEN: "nature unknown",
}
# Entries and comparisons have a hyphen in their names.
NAME = re.compile(r"(?:(?<=comparison )|(?<![\w./-]))[a-z_\d]+-[\w.-]*\w")


def linked_maths(entries: Collection[str], page: str = "") -> Callable[[str], Markup]:
    """What `mathematical` does, with links to what a text names.

    That are entries of the ledger, which is another `page` or this one, and behind the word
    "comparison" those of the report.

    >>> print(linked_maths({"eq-12"})("See eq-12 and eq-13"))
    See <a href="#eq-12">Eq. 12</a> and eq-13
    >>> print(linked_maths(())("comparison inelastic-rebound"))
    comparison <a href="report.html#inelastic-rebound">Inelastic, rebound</a>
    """

    def maths(text: str) -> Markup:
        html, done = Markup(), 0
        for found in NAME.finditer(text):
            name, link = found[0], Markup('<a href="{}#{}">{}</a>')
            if name in entries:
                linked = link.format(page, name, words.entry(name))
            elif text[: found.start()].endswith("comparison "):
                figure = words.figure(name.partition("-")[0])
                linked = link.format("report.html", name, f"{figure}, {words.comparison(name)}")
            else:
                continue
            html += mathematical(text[done : found.start()]) + linked
            done = found.end()
        return html + mathematical(text[done:])

    return maths


def by_cause(rows: Sequence[Row]) -> dict[str, list[Row]]:
    """Wrong rows by the text of their cause, the gravest ones first."""
    order = list(outcome.GRADES)
    wrong = [row for row in rows if row.get("cause")]
    causes: dict[str, list[Row]] = {}
    for row in sorted(wrong, key=lambda row: order.index(row["grade"])):
        causes.setdefault(row["because"], []).append(row)
    return causes


def page(rows: Sequence[Row], symbols: str, impacts: Mapping[str, Any], template: Path) -> str:
    """The page of the ledger's rows, by a template beside the style that it includes.

    `symbols` explains their formulas; `impacts` are those that the explorer shows, by entry.
    """
    environment = templates.environment(template.parent)
    environment.filters["maths"] = linked_maths({row["entry"] for row in rows})
    style = STYLE | GRADE_STYLE | NATURE_STYLE
    found = Counter(row["verdict"] for row in rows)
    return environment.get_template(template.name).render(
        entries=rows,
        symbols=symbols,
        counts={verdict: found[verdict] for verdict in STYLE if found[verdict]},
        graded=outcome.sentence_of_grades(rows),
        lapsed=outcome.failing(rows),
        causes=by_cause(rows),
        gravest=next(iter(outcome.GRADES)),
        style=style,
        explorer=impacts,
    )
