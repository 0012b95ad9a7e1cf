"""Texts with formulas, LaTeX between dollars, as HTML with MathML, or as plain text."""

import re
from contextlib import suppress

from docutils.utils.math.latex2mathml import tex2mathml  # type: ignore[import-untyped]
from markupsafe import Markup, escape

# A formula and the mark behind it, which stay on one line; code; a number with a power of ten.
SET = re.compile(r"\$([^$]+)\$([.,;:)]*)|`([^`]+)`|(?<![\w.])(\d[\d.]*)e([-+]?\d+)(?!\w)")


def mathematical(text: str) -> Markup:
    r"""A text as HTML: its `$formulas$` as MathML, `code`, powers of ten.

    An unknown command raises `docutils.utils.math.MathError`.

    >>> print(mathematical(r"$\mu^2$ < 2e-05"))
    <math><msup><mi>μ</mi><mn>2</mn></msup></math> &lt; 2×10<sup>−5</sup>
    """
    html, done = [], 0
    for found in SET.finditer(text):
        html += [escape(text[done : found.start()]), _set(*found.groups())]
        done = found.end()
    return Markup("").join([*html, escape(text[done:])])


def _set(formula: str, mark: str, code: str, digits: str, power: str) -> Markup:
    """One part of a text, by the groups of `SET`; those of other parts are None."""
    if formula:
        mathml = re.sub(r'\s*\n\s*| xmlns="[^"]*"', "", tex2mathml(formula))
        mathml = mathml.replace('<mo stretchy="false">/', '<mo lspace="0" rspace="0">/')
        # `{} + x` is a sum whose first part stands before it.
        html = Markup(mathml.replace("<mrow></mrow><mo>", '<mo form="infix">'))
        return Markup('<span class="joined">{}{}</span>').format(html, mark) if mark else html
    if code:
        return Markup("<code>{}</code>").format(code)
    times = "" if digits == "1" else f"{digits}×"
    return Markup("{}10<sup>{}</sup>").format(times, f"{int(power)}".replace("-", "−"))


def plain(text: str) -> str:
    r"""A text with its formulas in letters, for tables of the run and for alternative texts.

    >>> plain(r"at $\mu F_{2\mathrm{max}} \le t_c$, 5°")
    'at mu F2max <= t_c, 5 deg'
    """

    def letters(found: re.Match[str]) -> str:
        formula = found[1].replace(r"\le", "<=").replace(r"\ge", ">=").replace(r"\,", " ")
        formula = re.sub(r"_(?=\{?\d)|\\mathrm", "", formula)
        return re.sub(r"[\\{}]", "", formula)

    return re.sub(r"\$([^$]+)\$", letters, text).replace("°", " deg")


def number(text: str) -> Markup:
    """A cell of a table with three digits at most; of a cell that is no number the formulas.

    >>> print(number("0.123456"), number("1.56e+03"), number("1e-05"), number("lumped"))
    0.123 1560 10<sup>−5</sup> lumped
    """
    with suppress(ValueError):
        text = f"{float(f'{float(text):.3g}'):g}"
    return mathematical(text)
