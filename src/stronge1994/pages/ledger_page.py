"""Write the ledger's table as a page to read: one HTML file that needs no other file."""

import re
from collections import Counter
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any

from markupsafe import Markup

from stronge1994 import ledger_table, words
from stronge1994.formulas import mathematical
from stronge1994.ledger_table import GRADES
from stronge1994.pages import templates
from stronge1994.paper.entry import LEDGER, VERDICTS
from stronge1994.paper.words import SYMBOLS
from stronge1994.tables import Row

# Classes of the style, by verdict and by grade.
STYLE = dict(zip(VERDICTS, ("confirmed", "rounding", "wrong", "not"), strict=True))
GRADE_STYLE = dict(zip(GRADES, ("grave", "misprint", "judgement"), strict=True))
# Entries and comparisons have a hyphen in their names.
NAME = re.compile(r"(?:(?<=comparison )|(?<![\w./-]))[a-z_\d]+-[\w.-]*\w")
# Where a place in the paper names pages and equations.
PAGES = re.compile(r"\bpp?[.] (\d+(?: and \d+)*)")
EQUATIONS = re.compile(r"\bEqs?[.]? (\d+[a-c]?(?:(?:,| and| to) \d+[a-c]?)*)")
# A letter of a formula with its subscript; letters of an upright word are none.
LETTER = re.compile(
    r"\\mathrm\{\w+\}|((?:\\[A-Za-z]+|[A-Za-z])(?:_(?:\w|\{[^{}]*(?:\{\w+\})?\}))?'?)"
)
# Symbols of more than this share of the entries are explained once, above all; others where they
# are used.
OFTEN = 0.1
# Columns of what a reader sees of an entry at once; and those of what is folded, with words for it.
SHOWN = ("says", "correction", "only_if")
FOLDED = {
    "derivation": "derivation",
    "because": "cause",
    "range": "where it holds",
    "reading": "reading",
    "why": "why not testable",
    "found": "test",
}
CONDITIONAL = "right only under a condition"


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
    order = list(GRADES)
    wrong = [row for row in rows if row.get("cause")]
    causes: dict[str, list[Row]] = {}
    for row in sorted(wrong, key=lambda row: order.index(row["grade"])):
        causes.setdefault(row["because"], []).append(row)
    return causes


def numbers(named: re.Pattern[str], where: str) -> list[int]:
    """Numbers of the pages or of the equations that a place in the paper names.

    >>> numbers(EQUATIONS, "p. 439, Eqs 7a to 7c"), numbers(PAGES, "pp. 438 and 439, 2nd sentence")
    ([7], [438, 439])
    """
    return sorted({int(n) for found in named.findall(where) for n in re.findall(r"\d+", found)})


def letters(text: str) -> list[str]:
    r"""Letters in the formulas of a text, each with its subscript.

    >>> letters(r"$\mathrm{max}(0, p(t_c))$ is no $F_{2\mathrm{max}}$")
    ['p', 't_c', 'F_{2\\mathrm{max}}']
    """
    formulas = re.findall(r"\$([^$]+)\$", text)
    return [letter for formula in formulas for letter in LETTER.findall(formula) if letter]


def by_letter(symbols: str) -> dict[str, str]:
    """Parts of a text on symbols, by each letter that they explain.

    >>> by_letter("$u$, $v = w t$: velocities; $t$: time")
    {'u': '$u$, $v = w t$: velocities', 'v': '$u$, $v = w t$: velocities', 't': '$t$: time'}
    """
    return {
        letters(formula)[0]: part
        for part in symbols.split("; ")
        for formula in re.findall(r"\$[^$]+\$", part.partition(": ")[0])
    }


def explained(text: str, parts: Mapping[str, str], known: Collection[str] = ()) -> list[str]:
    """Parts of `by_letter` that explain a text, and those that explain these, but the known ones.

    >>> explained("$v$", by_letter("$u$: place; $v = w t$: velocity; $t$: time"))
    ['$v = w t$: velocity', '$t$: time']
    """
    found: list[str] = []
    asked = letters(text)
    for letter in asked:  # which grows
        part = parts.get(letter)
        if part and part not in known and part not in found:
            found.append(part)
            asked += letters(part)
    return found


def common(rows: Sequence[Row], parts: Mapping[str, str]) -> list[str]:
    """Parts of `by_letter` that explain what many entries have."""
    used = Counter(
        part for row in rows for part in {parts.get(letter) for letter in letters(shown(row))}
    )
    often = [part for part in dict.fromkeys(parts.values()) if used[part] > OFTEN * len(rows)]
    return explained(" ".join(often), parts)


def shown(row: Row) -> str:
    """What a reader sees of an entry at once."""
    return " ".join(row[column] for column in SHOWN)


def entry_of(row: Row, parts: Mapping[str, str], known: Collection[str]) -> dict[str, Any]:
    """A row with what the page says of it: what a filter finds it by, and its symbols."""
    symbols = explained(shown(row), parts, known)
    folded = " ".join(row[column] for column in FOLDED)
    kinds = [row["verdict"], row["grade"], CONDITIONAL if row["only_if"] else ""]
    return row | {
        "kinds": [kind for kind in kinds if kind],
        "equations": numbers(EQUATIONS, row["where"]),
        "pages": numbers(PAGES, row["where"]),
        "symbols": symbols,
        "more_symbols": explained(folded, parts, {*known, *symbols}),
        "folded": ", ".join(words for column, words in FOLDED.items() if row[column]),
    }


def page(rows: Sequence[Row]) -> str:
    """The page of the ledger's rows."""
    environment = templates.environment()
    environment.filters["maths"] = linked_maths({row["entry"] for row in rows})
    style = STYLE | GRADE_STYLE
    found = Counter(row["verdict"] for row in rows)
    parts = by_letter(SYMBOLS)
    known = common(rows, parts)
    entries = [entry_of(row, parts, known) for row in rows]
    causes = by_cause(rows)
    return environment.get_template("ledger.html").render(
        entries=entries,
        symbols=SYMBOLS,
        common=known,
        choices={
            "kind": ("Verdict", [*STYLE, CONDITIONAL, *GRADES]),
            "equation": ("Equation", sorted({n for entry in entries for n in entry["equations"]})),
            "page": ("Page", sorted({n for entry in entries for n in entry["pages"]})),
        },
        counts={verdict: found[verdict] for verdict in STYLE if found[verdict]},
        conditional=ledger_table.conditional(rows),
        graded=ledger_table.sentence_of_grades(rows),
        lapsed=ledger_table.failing(rows),
        causes=causes,
        symbols_of_causes=explained(
            " ".join(f"{row['because']} {row['correction']}" for row in sum(causes.values(), [])),
            parts,
            known,
        ),
        gravest=next(iter(GRADES)),
        style=style,
        explorer={name: made.explorer for name, made in LEDGER.items() if made.explorer},
    )
