"""Write the ledger's table as a page to read: one HTML file that needs no other file."""

import re
from collections import Counter
from collections.abc import Callable, Collection, Mapping, Sequence
from pathlib import Path
from typing import Any

from markupsafe import Markup, escape

from stronge1994.csv_tables import Row
from stronge1994.ledger import in_nature, outcome
from stronge1994.pages import templates

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
    "not testable": "outside what is modelled here, or no data",
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
    in_nature.STANDS: "stands",
    in_nature.FAILS: "contradicted",
    in_nature.DEPENDS: "depends",
    in_nature.OPEN: "unknown",
}
NATURE_MEANING = {
    in_nature.STANDS: "true with either loss",
    in_nature.FAILS: "false with either loss",
    in_nature.DEPENDS: "true with one loss, false with the other",
    in_nature.OPEN: "neither contact can tell",
}
GREEK = {
    "mu": "µ", "zeta": "ζ", "beta": "β", "Omega": "Ω", "omega": "ω", "kappa": "κ", "pi": "π",
    "phi": "φ", "psi": "ψ", "chi": "χ", "theta": "θ", "tau": "τ", "nu": "ν",
}  # fmt: skip
# A letter with an index: v1, F2, t_c, tf, ts, F2max, psi1, du1.
INDEXED = re.compile(r"\b(d?)([vuFDKmxtgV]|psi)(\d|_c|f|b|a|(?<=t)s)(max)?(?![A-Za-z0-9])")
# Symbols of one letter. A letter after a slash is a unit or part of a tag, and stays.
SYMBOL = re.compile(r"(?<![/<\w;])([eskxMS])(?![\w<>])|(?<!\w)(p)(?=\()")


def mathematical(text: str) -> Markup:
    """The plain formulas of the ledger as HTML: Greek letters, indices, powers.

    >>> print(mathematical("zeta^2 F1(t2) < mu"))
    ζ<sup>2</sup> <i>F</i><sub>1</sub>(<i>t</i><sub>2</sub>) &lt; µ
    """
    html = str(escape(text))
    html = INDEXED.sub(_indexed, html)
    html = SYMBOL.sub(lambda match: f"<i>{match[0]}</i>", html)
    html = re.sub(r"`([^`]+)`", r"<code>\1</code>", html)
    html = re.sub(r"\^(\d)", r"<sup>\1</sup>", html)
    html = re.sub(r"\b(" + "|".join(GREEK) + r")\b", lambda m: GREEK[m[1]], html)
    html = html.replace("+-", "±").replace("-&gt;", "→").replace("sqrt(", "√(")
    html = re.sub(r"(?:(?<=[ (=,])|^)-(?=[\dA-Za-zµζκΩω(<])", "−", html)
    return Markup(re.sub(r"(\d) deg\b", r"\1°", html.replace(" - ", " − ")))


def _indexed(match: re.Match[str]) -> str:
    change, letter, index, largest = match.groups()
    name = GREEK.get(letter, f"<i>{letter}</i>")
    top = f"<sup>{largest}</sup>" if largest else ""
    return f"{change}{name}<sub>{index.strip('_')}</sub>{top}"


def linked_maths(names: Collection[str]) -> Callable[[str], Markup]:
    """Formulas of a text as HTML, with links to the entries of the ledger that it names.

    Entries are named as "see NAME and NAME", as "ledger: NAME", and after an equation and a comma.

    >>> print(linked_maths({"eq-12"})("mu, see eq-12"))
    µ, see <a href="#eq-12">eq-12</a>
    """
    alternatives = "|".join(sorted(map(re.escape, names), key=len, reverse=True)) or "(?!)"
    link = re.compile(rf"(?:(?<=see )|(?<=and )|(?<=ledger: )|(?<=eq-\d\d, ))({alternatives})\b")

    def maths(text: str) -> Markup:
        parts = link.split(text)
        return Markup("").join(
            Markup('<a href="#{0}">{0}</a>').format(part) if part in names else mathematical(part)
            for part in parts
        )

    return maths


def words(rows: Sequence[Row], symbols: Mapping[str, str]) -> dict[str, Any]:
    """What the templates need to show the ledger's rows; `symbols` explains their formulas."""
    counts = Counter(row["verdict"] for row in rows)
    of_nature = [row for row in rows if row.get("in_nature")]
    in_words = Counter(row["in_nature"] for row in of_nature)
    return {
        "entries": rows,
        "of_nature": of_nature,
        "nature_counts": {verdict: in_words[verdict] for verdict in NATURE_STYLE},
        "nature_style": NATURE_STYLE,
        "nature_meaning": NATURE_MEANING,
        "symbols": symbols,
        "lapsed": outcome.failing(rows),
        "counts": {verdict: counts[verdict] for verdict in STYLE if counts[verdict]},
        "grades": outcome.grades(rows),
        "graded": outcome.grades_in_words(rows),
        "causes": by_cause(rows),
        "style": STYLE | GRADE_STYLE,
        "meaning": MEANING | GRADE_MEANING,
    }


def by_cause(rows: Sequence[Row]) -> dict[str, list[Row]]:
    """Wrong rows by their cause, `{cause in words: rows}`, the gravest ones first."""
    order = list(outcome.GRADES)
    wrong = [row for row in rows if row.get("cause")]
    causes: dict[str, list[Row]] = {}
    for row in sorted(wrong, key=lambda row: order.index(row["grade"])):
        causes.setdefault(row["because"], []).append(row)
    return causes


def page(rows: Sequence[Row], symbols: Mapping[str, str], template: str) -> str:
    """The page of the ledger's rows, by a template beside the parts that it includes."""
    environment = templates.environment(Path(template).parent)
    environment.filters["maths"] = linked_maths({row["entry"] for row in rows})
    return environment.get_template(Path(template).name).render(words(rows, symbols))
