"""A reading: the file that fills an awaited series.

Its head, lines `# key: value` above the table, says who read the points, when, and how well.
figures/your_copy.html writes it.
"""

import datetime
import math
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from stronge1994.reference_data.series import NUMBER, SourceError, head_and_table, text_of

# What a head must have, and what is needed there.
OF_SIGMA = "one standard deviation, in the unit of this axis, a positive number as 0.012"
WANTED = {
    "who": "the name of who read the points",
    "when": "the day of the reading, as 2026-11-28, not a later one than today",
    "from": "what was read, as Fig. 5, p. 444 of my copy, scanned at 300 dpi",
    "how": "the program, and how it was calibrated",
    "sigma_x": OF_SIGMA,
    "sigma_y": OF_SIGMA,
    "sigma_origin": "where sigma comes from, as two readings, in 10 characters or more",
}
# What it may have.
MORE = {"series": "", "sigma_values": "on how many values sigma rests, a whole number from 1 on"}
OF_SETTING = "for which value the points hold, a positive number as 0.83"
# Fewest characters of texts; the schema asks the same of an origin of sigma.
LEAST = {"who": 3, "from": 3, "how": 3, "sigma_origin": 10}
PLACEHOLDER = re.compile(
    r"<.*>|\W*|x+|(your|todo|tbd)\b.*|(the )?name|who|when|from|how|none|n/a|unknown", re.I
)


def filled(series: Mapping[str, Any], file: Path) -> dict[str, Any]:
    """The entry of an awaited series, digitised as the head of this file says."""
    asked = series.get("open", [])
    head = _head(file, WANTED | dict.fromkeys(asked, OF_SETTING))
    entry = {
        **series,
        "kind": "digitised",
        "path": str(file),
        "digitised_by": "{who}, {when}, from {from}, {how}".format(**head),
        "x": series["x"] | {"sigma": float(head["sigma_x"])},
        "y": series["y"] | {"sigma": float(head["sigma_y"])},
        "sigma_origin": head["sigma_origin"],
        "settings": series.get("settings", {}) | {key: float(head[key]) for key in asked},
    }
    if "sigma_values" in head:
        entry["sigma_values"] = int(head["sigma_values"])
    return entry


def _head(file: Path, wanted: Mapping[str, str]) -> dict[str, str]:
    """Values of a head, which has these keys."""
    allowed, head = {**wanted, **MORE}, {}
    for number, line in enumerate(head_and_table(text_of(file))[0], 1):
        # Excel puts quotes around a line that has commas, and commas behind one that has few.
        key, colon, value = map(str.strip, line.strip('", \t\r\n').lstrip("# \t").partition(":"))
        where = f"{file}, line {number}:"
        if key == "series" and value != f"{file.parent.name}/{file.stem}":
            belongs = ascii(f"{value}; it belongs to data/{value}.csv")[1:-1]
            raise SourceError(f"{where} this is a reading of {belongs}")
        if key in head:
            raise SourceError(f"{where} {key} stands twice")
        if colon and key not in allowed:
            raise SourceError(
                f"{where} {key[:60]!a} is no key of a head; allowed are {', '.join(allowed)}"
            )
        if colon and key != "series" and not _is_admissible(key, value):
            raise SourceError(f"{where} {key} = {value[:60]!a}; needed is {allowed[key]}")
        if colon:
            head[key] = value.replace("$", "")  # which begins a formula on the pages
    if not head:
        raise SourceError(
            f"{file}: lines as `# who: Ada Reader` are missing above the table, with "
            f"{', '.join(wanted)}; figures/your_copy.html writes them"
        )
    for key, what in wanted.items():
        if key not in head:
            raise SourceError(f"{file}: a line `# {key}:` is missing; needed is {what}")
    return head


def _is_admissible(key: str, value: str) -> bool:
    if key in LEAST:
        return len(value) >= LEAST[key] and not PLACEHOLDER.fullmatch(value)
    if key == "sigma_values":
        return bool(re.fullmatch("[1-9][0-9]{0,5}", value))
    if key != "when":
        return bool(NUMBER.fullmatch(value)) and 0 < float(value) < math.inf
    # The day begins there first: a reader may be ahead of this computer.
    first = datetime.timezone(datetime.timedelta(hours=14))
    try:
        day = datetime.date.fromisoformat(value)
    except ValueError:
        return False
    return f"{day}" == value and day <= datetime.datetime.now(first).date()
