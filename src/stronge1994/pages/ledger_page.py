"""Write the ledger's table as a page to read: one HTML file that needs no other file."""

import math
import re
from collections import Counter
from collections.abc import Callable, Collection, Sequence
from pathlib import Path
from typing import Any

from markupsafe import Markup

from stronge1994.csv_tables import Row
from stronge1994.formulas import mathematical
from stronge1994.ledger import finding, outcome
from stronge1994.pages import names, templates

STYLE = {
    "confirmed": "confirmed",
    "confirmed within rounding": "rounding",
    "wrong": "wrong",
    "not testable": "not",
}
MEANING = {
    "confirmed": "true as it stands, in the range that the entry names",
    "confirmed within rounding": "the stated number is the right one, rounded",
    "wrong": "false as read here; the entry says what is right, and why",
    "not testable": "outside what is modelled here, or no data, or a matter of one character of "
    "our scan",
}
GRADE_STYLE = {
    "changes a result": "grave",
    "sign or misprint": "misprint",
    "matter of judgement": "judgement",
}
GRADE_MEANING = {
    "changes a result": "a limit, a formula or a number of the paper comes out otherwise, under "
    "every fair reading",
    "sign or misprint": "one sign, digit or word, perhaps the scan's; the paper has it right "
    "elsewhere, or asks for it",
    "matter of judgement": "approximate words, or a sentence that stands under another fair "
    "reading, which the entry names",
}
NATURE_STYLE = {
    finding.STANDS: "stands",
    finding.FAILS: "contradicted",
    finding.DEPENDS: "depends",
    finding.OPEN: "unknown",
}
NATURE_MEANING = {
    finding.STANDS: "true with either loss",
    finding.FAILS: "false with either loss",
    finding.DEPENDS: "true with one loss, false with the other",
    finding.OPEN: "neither contact can tell",
}
# Impacts of the paper's sphere to which an entry refers: incidence, friction, restitution, and the
# view of the explorer.
IN_EXPLORER = {
    "slip-throughout-limit": (6.4, 0.5, 1, "velocity"),
    "limit-falls-with-losses": (4.5, 0.5, 0.5, "velocity"),
    "last-slip-reverses-after-slip": (3.2, 0.5, 0.5, "velocity"),
    "restitution-change-falls": (3, 0.5, 0.5, "velocity"),
    "practically-identical": (1.21, 0.5, 1, "velocity"),
    "stick-in-compression": (4.5, 0.5, 1, "velocity"),
    "still-moving-at-stick": (4.5, 0.5, 1, "velocity"),
    "peak-after-stick": (4.5, 0.5, 1, "forces"),
    "eq-32-late": (4.5, 0.5, 1, "forces"),
    "peak-angle-0.18": (2.93, 0.18, 1, "forces"),
    "eq-39": (0.5, 0.5, 1, "energy"),
    "eq-40": (2, 0.5, 1, "energy"),
    "largest-dissipation-angle": (14.07, 0.1, 1, "energy"),
}


def explorer_state(incidence: float, friction: float, restitution: float, view: str) -> str:
    """Address, within the explorer's page, of an impact of the paper's sphere, by its model.

    >>> explorer_state(2, 0.5, 1, "energy")
    'angle=45&friction=0.5&restitution=1&poisson_ratio=0.3&mass_ratio=3.5&of=lumped&view=energy'
    """
    angle = math.degrees(math.atan(friction * incidence))
    return (
        f"angle={angle:.4g}&friction={friction:g}&restitution={restitution:g}"
        f"&poisson_ratio=0.3&mass_ratio=3.5&of=lumped&view={view}"
    )


def linked_maths(entries: Collection[str], page: str = "") -> Callable[[str], Markup]:
    """Formulas of a text as HTML, with links to what it names.

    Entries of the ledger, which is another `page` or this one, are named as "see NAME and NAME",
    as "ledger: NAME", and after an equation and a comma; comparisons of the report as
    "comparison NAME".

    >>> print(linked_maths({"eq-12"})("It slips, see eq-12"))
    It slips, see <a href="#eq-12">Eq. 12</a>
    >>> print(linked_maths(())("comparison inelastic-rebound"))
    comparison <a href="report.html#inelastic-rebound">Inelastic, rebound</a>
    """
    alternatives = "|".join(sorted(map(re.escape, entries), key=len, reverse=True)) or "(?!)"
    before = r"(?<=see )|(?<=and )|(?<=ledger: )|(?<=eq-\d\d, )"
    link = re.compile(rf"(?:{before})(?:{alternatives})\b|(?<=comparison )[a-z_\d]+-[\w.-]*\w")

    def linked(name: str) -> Markup:
        if name in entries:
            return Markup('<a href="{}#{}">{}</a>').format(page, name, names.entry(name))
        words = f"{templates.title(name.partition('-')[0])}, {names.comparison(name)}"
        return Markup('<a href="report.html#{}">{}</a>').format(name, mathematical(words))

    def maths(text: str) -> Markup:
        html, done = [], 0
        for found in link.finditer(text):
            html += [mathematical(text[done : found.start()]), linked(found[0])]
            done = found.end()
        return Markup("").join([*html, mathematical(text[done:])])

    return maths


def template_values(rows: Sequence[Row], symbols: str) -> dict[str, Any]:
    """Values of the templates for the ledger's rows; `symbols` explains their formulas."""
    counts = Counter(row["verdict"] for row in rows)
    of_nature = [row for row in rows if row.get("in_nature")]
    verdicts_in_nature = Counter(row["in_nature"] for row in of_nature)
    return {
        "entries": rows,
        "of_nature": of_nature,
        "nature_counts": {verdict: verdicts_in_nature[verdict] for verdict in NATURE_STYLE},
        "nature_style": NATURE_STYLE,
        "nature_meaning": NATURE_MEANING,
        "symbols": symbols,
        "lapsed": outcome.failing(rows),
        "counts": {verdict: counts[verdict] for verdict in STYLE if counts[verdict]},
        "grades": outcome.grades(rows),
        "graded": outcome.sentence_of_grades(rows),
        "causes": by_cause(rows),
        "style": STYLE | GRADE_STYLE,
        "meaning": MEANING | GRADE_MEANING,
    }


def by_cause(rows: Sequence[Row]) -> dict[str, list[Row]]:
    """Wrong rows by the text of their cause, the gravest ones first."""
    order = list(outcome.GRADES)
    wrong = [row for row in rows if row.get("cause")]
    causes: dict[str, list[Row]] = {}
    for row in sorted(wrong, key=lambda row: order.index(row["grade"])):
        causes.setdefault(row["because"], []).append(row)
    return causes


def page(rows: Sequence[Row], symbols: str, template: str) -> str:
    """The page of the ledger's rows, by a template beside the style that it includes."""
    environment = templates.environment(Path(template).parent)
    environment.filters |= {
        "maths": linked_maths({row["entry"] for row in rows}),
        "entry_name": names.entry,
    }
    return environment.get_template(Path(template).name).render(
        template_values(rows, symbols),
        kinds=Counter(row["kind"] for row in rows),
        gravest=next(iter(outcome.GRADES)),
        explorer=IN_EXPLORER,
        explorer_state=explorer_state,
    )
