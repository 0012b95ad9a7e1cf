"""Plain formulas in a text, such as `zeta^2 F1(t2) < mu`, as MathML.

A formula is recognised by its beginning, and read as far as this grammar goes. All else is text.

- A formula is sides with relations between them: `zeta^2 < mu x`.
- A side is terms with signs between them: `1 + e - e^2`.
- A term is factors, with spaces or brackets between them, and fractions: `2 mu F1/(m1 m2)`.
- A factor is a number, a symbol, a function of sides, or a side in brackets or bars, to a power.

No bracket of a formula holds a word, and a number alone is no formula. So `(1 + e) m2/m1` is one,
and "(see Eq. 7)" is none. The numerator of a fraction is all factors since the last fraction. The
exception is a ratio of one letter, as m2/m1: `e m2/m1` is e times that ratio.
"""

import re
from contextlib import suppress
from functools import cache
from typing import NamedTuple

from markupsafe import Markup, escape

GREEK = {
    "alpha": "α", "mu": "μ", "zeta": "ζ", "beta": "β", "Omega": "Ω", "omega": "ω", "kappa": "κ",
    "pi": "π", "phi": "φ", "psi": "ψ", "chi": "χ", "theta": "θ", "tau": "τ", "nu": "ν",
    "delta": "δ",
}  # fmt: skip
FUNCTIONS = ("sin", "cos", "tan", "acos", "max", "sqrt")
RELATIONS = {"<=": "≤", ">=": "≥", "->": "→", "=": "=", "<": "&lt;", ">": "&gt;"}
SIGNS = {"+-": "±", "+": "+", "-": "−"}
CLOSING = {"(": ")", "[": "]", "|": "|"}

# Not a number: the 7 of Eq. 7c, or of 7.5.1.
NUMBER = re.compile(r"\d+(?:\.\d+)?(?:e(?P<power>-?\d+))?(?![\w]|\.\d)(?P<degrees> deg\b)?")
NUMBER_NEXT = re.compile(r" \d")
# v1, F2, t_c, tf, ts, F2max, psi1, beta_0, e_t; with d a differential, as du1 or dt.
INDEXED = re.compile(
    r"(?P<change>d?)(?P<letter>[vuFDKWmxtgp]|psi|beta(?=_0)|e(?=_t)|(?:a|delta)(?=_max))"
    r"(?:(?P<index>\d|_[c0t]|_max|(?<=t)[fbas])(?P<largest>max)?)?(?![A-Za-z0-9])"
)
# Not a letter: the initials in "M. S. Smith", and the article "a".
LETTER = re.compile(
    rf"(?P<name>{'|'.join(GREEK)}|[eskx]|E\*|a(?=\^)|w(?=[\^/]| = )|[MSR](?!\. [A-Z]))"
    r"(?P<prime>'?)(?!\w|-\w)"
)
# p, t and v without an index are symbols only if this follows, or a d stands before them.
BARE = re.compile(r"[ptv](?=\(| [=+-] |/)|d[ptv]\b|t\b(?!\.)")
# A formula begins behind one of these, not inside a word or behind the stroke of a unit. The 38 of
# "In Eq. 38 s has" is no factor, and the letter of "part (e)" no symbol.
BEFORE = re.compile(r"(?:^|(?<=[\s(\[;:]))(?<!Eq\. )(?<!Eqs )(?<!Figs )(?<!Fig\. )(?<!\bp\. )")
MAY_BEGIN = re.compile(r"(?!\(?[a-z]\))[A-Za-z0-9(\[|+-]")
AFTER = re.compile(r"(?!\w|-\w)")
MARK = re.compile(r"[.,;:)]+")
# A formula with more characters may be broken before a sum or a relation.
LONGEST_IN_ONE_PIECE = 36


class _Factor(NamedTuple):
    html: str
    letter: str = ""  # of a symbol
    kind: str = ""  # "group", "fraction", "function", "indexed", "differential"
    inside: str = ""  # what a group holds
    lone_fraction: bool = False


class _Part(NamedTuple):
    """A term or side between two operators outside of brackets, with the operator before it."""

    start: int
    operator: str
    html: str


class _Reader:
    """Read one formula from a place of a text; methods return None where they find nothing."""

    def __init__(self, text: str, at: int) -> None:
        self.text, self.at = text, at
        self.in_bars = False

    def _take(self, *candidates: str) -> str | None:
        for candidate in candidates:
            if self.text.startswith(candidate, self.at):
                self.at += len(candidate)
                return candidate
        return None

    def formula(self) -> list[_Part] | None:
        parts = self.side("", self.at)
        while parts:
            start = self.at
            relation = self._take(*(f" {word} " for word in RELATIONS))
            more = relation and self.side(_operator(RELATIONS[relation.strip()]), start)
            if not more:
                self.at = start
                break
            parts += more
        return parts or None

    def side(self, operator: str, start: int) -> list[_Part] | None:
        """Terms with the signs between them; `operator` is what stands before the first one."""
        sign = self._take(*SIGNS)
        term = self.term()
        if term is None:
            return None
        lead = f'<mo form="prefix">{SIGNS[sign]}</mo>' if sign else ""
        parts = [_Part(start, operator, lead + term)]
        while True:
            start = self.at
            sign = self._take(*(f" {word} " for word in SIGNS))
            term = self.term() if sign else None
            if sign is None or term is None:
                self.at = start
                return parts
            parts.append(_Part(start, _operator(SIGNS[sign.strip()]), term))

    def term(self) -> str | None:
        factor = self.factor()
        if factor is None:
            return None
        factors = [factor]
        while True:
            start = self.at
            if self._take("/"):
                below = self.factor()
                if below is None:
                    self.at = start
                    break
                _divide(factors, below)
                continue
            # "(m2/m1)(1 + e)" is a product too, but "zeta^2 0.5" is none.
            close = self.text[start - 1] in ")]" and self.text[start : start + 1] in ("(", "[")
            if not close and (NUMBER_NEXT.match(self.text, start) or not self._take(" ")):
                break
            factor = self.factor()
            if factor is None:
                self.at = start
                break
            factors.append(factor)
        return _product(factors)

    def factor(self) -> _Factor | None:
        base = self._number() or self._function() or self._symbol() or self._group()
        start = self.at
        if base is None or not self._take("^"):
            return _open(base) if base else None
        power = self._number() or self._group()
        if power is None:
            self.at = start
            return base
        html = f"<msup><mrow>{base.html}</mrow>{_row(power.inside or power.html)}</msup>"
        return _Factor(html, kind="power")

    def _number(self) -> _Factor | None:
        match = NUMBER.match(self.text, self.at)
        if not match:
            return None
        self.at = match.end()
        digits = match[0].removesuffix(match["degrees"] or "")
        if match["power"]:
            digits, _, power = digits.partition("e")
            times = "" if digits == "1" else f"<mn>{digits}</mn><mo>×</mo>"
            return _Factor(
                f"{times}<msup><mn>10</mn><mn>{str(int(power)).replace('-', '−')}</mn></msup>"
            )
        return _Factor(f"<mn>{digits}{'°' if match['degrees'] else ''}</mn>")

    def _function(self) -> _Factor | None:
        start = self.at
        name = self._take(*(f"{word}(" for word in FUNCTIONS), *(f"{w}^2(" for w in FUNCTIONS))
        if name is None:
            return None
        self.at -= 1
        arguments = self._group()
        if arguments is None:
            self.at = start
            return None
        word, _, power = name[:-1].partition("^")
        if word == "sqrt":
            return _Factor(f"<msqrt>{arguments.inside}</msqrt>")
        html = f"<mi>{word}</mi>"
        if power:
            html = f"<msup>{html}<mn>{power}</mn></msup>"
        return _Factor(f"{html}<mo>&#8289;</mo>{arguments.html}", kind="function")

    def _symbol(self) -> _Factor | None:
        symbol = self._indexed() or self._letter()
        if symbol is None:
            return None
        # v1(0) is a value of v1; mu (1 + e), with a space, is a product.
        start = self.at
        if symbol.kind == "indexed" and self.text[start : start + 1] == "(":
            value = self._group()
            if value is None:
                self.at = start
                return None
            return _Factor(f"{symbol.html}<mo>&#8289;</mo>{value.html}", symbol.letter)
        return symbol

    def _indexed(self) -> _Factor | None:
        match = INDEXED.match(self.text, self.at)
        if not match or not (match["index"] or BARE.match(self.text, self.at)):
            return None
        self.at = match.end()
        letter = f"<mi>{GREEK.get(match['letter'], match['letter'])}</mi>"
        index = (match["index"] or "").strip("_")
        if index:
            below = f"<mn>{index}</mn>" if index.isdigit() else f"<mi>{index}</mi>"
            letter += below
            letter = (
                f"<msubsup>{letter}<mi>max</mi></msubsup>"
                if match["largest"]
                else f"<msub>{letter}</msub>"
            )
        if match["change"]:
            letter = f'<mi mathvariant="normal">d</mi>{letter}'
            return _Factor(letter, match["letter"], "differential")
        return _Factor(letter, match["letter"], "indexed")

    def _letter(self) -> _Factor | None:
        match = LETTER.match(self.text, self.at)
        if not match:
            return None
        self.at = match.end()
        html = f"<mi>{GREEK.get(match['name'], match['name'])}</mi>"
        if match["prime"]:
            html = f"<msup>{html}<mo>′</mo></msup>"
        return _Factor(html, match["name"])

    def _group(self) -> _Factor | None:
        start, bars = self.at, self.in_bars
        opening = self._take("(", "[", *(() if bars else ("|",)))
        if opening is None:
            return None
        self.in_bars = opening == "|"
        parts = self.side("", self.at)
        listed = _joined(parts) if parts else ""
        while parts and self._take(", "):
            parts = self.side("", self.at)
            listed += "<mo>,</mo>" + _joined(parts) if parts else ""
        self.in_bars = bars
        if not parts or not self._take(CLOSING[opening]):
            self.at = start
            return None
        fence = f"<mo>{opening}</mo>{listed}<mo>{CLOSING[opening]}</mo>"
        inside = listed if opening != "|" else ""
        alone = opening == "(" and _is_fraction(listed)
        return _Factor(f"<mrow>{fence}</mrow>", "", "group", inside, alone)


def _operator(sign: str) -> str:
    return f'<mo form="infix">{sign}</mo>'


def _joined(parts: list[_Part]) -> str:
    return "".join(part.operator + part.html for part in parts)


def _row(html: str) -> str:
    return f"<mrow>{html}</mrow>"


def _is_fraction(html: str) -> bool:
    """Whether a formula is one fraction and nothing else."""
    return html.startswith("<mfrac>") and html.find("</mfrac>") == len(html) - len("</mfrac>")


def _open(factor: _Factor) -> _Factor:
    """A factor without its brackets, where they hold a fraction alone."""
    return _Factor(factor.inside, kind="fraction") if factor.lone_fraction else factor


def _divide(factors: list[_Factor], below: _Factor) -> None:
    """Put what `factors` have since the last fraction, or a ratio of one letter, over `below`."""
    first = len(factors) - 1
    ratio = below.letter and factors[-1].letter == below.letter
    if not (ratio or below.kind == "differential"):
        while first > 0 and factors[first - 1].kind != "fraction":
            first -= 1
    above = factors[first:]
    del factors[first:]
    top = above[0].inside if len(above) == 1 and above[0].inside else _product(above)
    bottom = below.inside or below.html
    factors.append(_Factor(f"<mfrac>{_row(top)}{_row(bottom)}</mfrac>", kind="fraction"))


def _product(factors: list[_Factor]) -> str:
    html = factors[0].html
    for factor in factors[1:]:
        space = ' lspace=".17em"' if factor.kind == "function" else ""
        html += f"<mo{space}>&#8290;</mo>{factor.html}"
    return html


def _pieces(text: str, parts: list[_Part], end: int, mark: str) -> str:
    """A formula in few short pieces, between which a line may break, and the mark at its end."""
    stops = [part.start for part in parts[1:]] + [end]
    pieces: list[list[_Part]] = []
    for part, stop in zip(parts, stops, strict=True):
        if pieces and stop - pieces[-1][0].start <= LONGEST_IN_ONE_PIECE:
            pieces[-1].append(part)
        else:
            pieces.append([part])
    ends = [piece[0].start for piece in pieces[1:]] + [end]
    html = [
        _math(text[piece[0].start : stop], _joined(piece))
        for piece, stop in zip(pieces, ends, strict=True)
    ]
    if mark:
        html[-1] = f'<span class="joined">{html[-1]}{mark}</span>'
    # The space between two pieces is enough before an operator.
    return " ".join([html[0], *(piece.replace("<mo", '<mo lspace="0"', 1) for piece in html[1:])])


def _math(plain: str, html: str) -> str:
    return f'<math alttext="{escape(plain.strip())}">{html}</math>'


def _plain_text(text: str) -> str:
    """Text without formulas: degrees, negative numbers, powers of units."""
    html = re.sub(r"(\d) deg\b", r"\1°", str(escape(text)))
    html = re.sub(r"(?<![\w.-])-(?=\d)", "−", html)
    html = re.sub(r"(?<=kg/m)3\b", "<sup>3</sup>", html)
    return re.sub(r"\^(−?\d+)", r"<sup>\1</sup>", html)


def _formula(text: str, at: int) -> tuple[list[_Part], int] | None:
    """The formula that begins at a place of a text, and where it ends."""
    if not (MAY_BEGIN.match(text, at) and BEFORE.match(text, at)):
        return None
    reader = _Reader(text, at)
    parts = reader.formula()
    # A number alone stays text, unless it has a power of ten.
    if not parts or not re.search("<mi|<msup", _joined(parts)):
        return None
    if not AFTER.match(text, reader.at):
        return None
    return parts, reader.at


@cache
def _mathematical(text: str) -> str:
    html, done, at = [], 0, 0
    while at < len(text):
        formula = _formula(text, at)
        if formula is None:
            at += 1
            continue
        parts, end = formula
        mark = MARK.match(text, end)
        html += [_plain_text(text[done:at]), _pieces(text, parts, end, mark[0] if mark else "")]
        done = at = mark.end() if mark else end
    return "".join([*html, _plain_text(text[done:])])


def mathematical(text: str) -> Markup:
    """A text whose plain formulas are MathML, and whose `code` is HTML.

    The result is safe HTML. Each formula keeps its plain form as `alttext`. The class `joined` is
    for what must not be broken: a formula and the mark behind it.

    >>> print(mathematical("mu < 1 of Eq. 7c"))
    <math alttext="mu &lt; 1"><mi>μ</mi><mo form="infix">&lt;</mo><mn>1</mn></math> of Eq. 7c
    >>> print(mathematical("e t_c"))
    <math alttext="e t_c"><mi>e</mi><mo>&#8290;</mo><msub><mi>t</mi><mi>c</mi></msub></math>
    """
    parts = re.split(r"`([^`]+)`", text)
    html = [
        f"<code>{escape(part)}</code>" if place % 2 else _mathematical(part)
        for place, part in enumerate(parts)
    ]
    return Markup("".join(html))


def number(text: str) -> Markup:
    """A cell of a table with three digits at most; of a cell that is no number the formulas.

    >>> print(number("0.123456"), number("1.56e+03"), number("lumped"))
    0.123 1560 lumped
    >>> print(number("1e-05"))
    <math alttext="1e-05"><msup><mn>10</mn><mn>−5</mn></msup></math>
    """
    with suppress(ValueError):
        text = f"{float(f'{float(text):.3g}'):g}".replace("e+", "e")
    return mathematical(text)
