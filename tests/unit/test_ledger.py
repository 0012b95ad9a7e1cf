"""The judgement of the ledger's entries, in both directions."""

import math

import pytest

from planarimpact import ledger
from planarimpact.ledger import finding
from planarimpact.ledger.finding import Finding

RIGHT = {"verdict": "confirmed", "confirms": {"at_most": 1e-9}}
ROUNDED = {"verdict": "confirmed within rounding", "confirms": {"value": 1.7, "rounding": 0.05}}
WRONG = {"verdict": "wrong", "confirms": {"at_most": 1e-9}, "between": [0.9, 1.1]}


@pytest.mark.parametrize(
    ("entry", "found", "why"),
    [
        (RIGHT, Finding(0.0), ""),
        (RIGHT, Finding(0.1), "recorded as confirmed, found wrong"),
        (RIGHT, Finding(math.nan), "recorded as confirmed, found wrong"),
        (ROUNDED, Finding(1.7007), ""),
        (ROUNDED, Finding(1.7), "recorded as confirmed within rounding, found confirmed"),
        (ROUNDED, Finding(1.76), "recorded as confirmed within rounding, found wrong"),
        (WRONG, Finding(1.0), ""),
        (WRONG, Finding(1.0, 1e-14), ""),
        (WRONG, Finding(1.0, 1e-3), "the corrected formula is off by 0.001"),
        (WRONG, Finding(1.0, math.nan), "the corrected formula is off by nan"),
        (WRONG, Finding(1e-12), "recorded as wrong, found confirmed"),
        (WRONG, Finding(1.2), "1.2 lies outside 0.9 to 1.1"),
        (WRONG, Finding(math.nan), "nan lies outside 0.9 to 1.1"),
    ],
)
def test_an_entry_holds_or_says_why_not(entry, found, why):
    judged = ledger.judge(found, entry)
    assert judged.holds is (why == "")
    assert judged.why.startswith(why)


def test_at_least_is_a_bound_from_below():
    assert finding.verdict(1.0, {"at_least": 0.9}) == "confirmed"
    assert finding.verdict(0.8, {"at_least": 0.9}) == "wrong"


@pytest.mark.parametrize("name", ["slip.no_such_check", "no_such_module.check", "slip"])
def test_an_unknown_check_is_refused(name):
    with pytest.raises(LookupError, match=name):
        ledger.run(name)
