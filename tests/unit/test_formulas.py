"""Formulas of the ledger, the sources and the figures: what stands between dollars can be set."""

import re
from pathlib import Path

import yaml
from docutils.utils.math import MathError

from stronge1994 import formulas, ledger
from stronge1994.plan import figures

ROOT = Path(__file__).parents[2]


def texts(content, place=""):
    """All texts of a file, each behind its place."""
    if isinstance(content, dict):
        for key, value in content.items():
            yield from texts(value, f"{place}.{key}")
    elif isinstance(content, list):
        for number, value in enumerate(content):
            yield from texts(value, f"{place}[{number}]")
    elif isinstance(content, str) and not place.endswith("$ref"):
        yield place, content


def faults(content):
    """Texts whose formulas cannot be set, with the reason."""
    for place, text in texts(content):
        try:
            html = str(formulas.mathematical(text))
        except MathError as error:
            yield f"{place}: {error}"
            continue
        words = re.sub("<math.*?</math>|<code>.*?</code>", "", html)
        if re.search(r"[$\\]", words + formulas.plain(text)):
            yield f"{place}: {text}"


def test_every_formula_can_be_set():
    files = [*(ROOT / "data").glob("*/*.yaml"), *figures.FOLDER.glob("*/figure.yaml")]
    contents = {str(path): yaml.safe_load(path.read_text(encoding="utf-8")) for path in files}
    assert len(contents) > 30
    assert not list(faults(contents))
    assert not list(faults({name: check.__doc__ for name, check in ledger.checks().items()}))


def test_a_formula_that_cannot_be_set_is_told_with_its_place():
    (told,) = faults({"eq-07": {"says": r"$\zeta^2 < 1$", "holds": r"$\zeto$"}})
    assert told.startswith(".eq-07.holds: ")
    assert list(faults(["$e", r"\mu"])) == ["[0]: $e", r"[1]: \mu"]
