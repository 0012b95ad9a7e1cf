"""Formulas of the ledger, the sources and the figures: what stands between dollars can be set."""

import re
from pathlib import Path

import yaml

from stronge1994 import formulas, paper, words
from stronge1994.paper.entry import LEDGER
from stronge1994.settings import figures

ROOT = Path(__file__).parents[2]


def texts(content):
    """All texts of a file but references of a schema."""
    if isinstance(content, dict):
        content = [value for key, value in content.items() if key != "$ref"]
    if isinstance(content, list):
        for one in content:
            yield from texts(one)
    elif isinstance(content, str):
        yield content


def test_a_unit_that_readers_see_is_that_of_the_table():
    """Its formula has the same letters, so that no two units look alike."""
    others = {"1": "", "us": "µs", "deg": " deg", "kg/m^3": "kg/m³"}
    for name, shown in words.UNITS.items():
        assert formulas.plain(shown) == others.get(name, name)


def test_every_formula_can_be_set():
    """And what is left beside it has no stray `$` or command."""
    files = [*(ROOT / "data").glob("*/*.yaml"), *figures.PACKAGE.glob("*/*/figure.yaml")]
    assert len(files) > 30
    contents = [yaml.safe_load(path.read_text(encoding="utf-8")) for path in files]
    stated = [[entry.says, entry.test, *entry.words.values()] for entry in LEDGER.values()]
    for text in texts([contents, stated, paper.SYMBOLS, list(paper.CAUSES.values())]):
        rest = re.sub("<math.*?</math>|<code>.*?</code>", "", formulas.mathematical(text))
        assert not re.search(r"[$\\]", rest + formulas.plain(text)), text
