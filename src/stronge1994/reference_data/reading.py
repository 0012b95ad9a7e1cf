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

from stronge1994.reference_data.calibration import ANY, FLAT_BED, Calibration
from stronge1994.reference_data.formats import Faults, SourceError, head_and_table, shown, text_of
from stronge1994.reference_data.series import NUMBER, Series

# What a head must have, and what is needed there.
ONE = "one standard deviation, in the unit of this axis, a positive number as 0.012"
WANTED = {
    "who": "the name of who read the points",
    "when": "the day of the reading, as 2026-11-28, not a later one than today",
    "from": "what was read, as Fig. 5, p. 444 of my copy, scanned at 300 dpi",
    "how": "the program, and how it was calibrated",
    "axes": "the first and the last value of x and of y in the print, as 0 to 8; -3 to 1",
    "marks": "x and y of three places or more by which it was calibrated, as 0 0; 8 0; 0 -3; 8 -3",
    "mark_sigma_x": ONE,
    "mark_sigma_y": ONE,
    "sigma_x": ONE,
    "sigma_y": ONE,
    "sigma_origin": "where sigma comes from, as two readings, in 10 characters or more",
}
# What it may have.
MORE = {
    "series": "",
    "tilt": f"{ANY:g}, or {FLAT_BED:g} for a flat-bed scan",
    "sigma_values": "on how many values sigma rests, a whole number from 1 on",
    "line_width": "the width of the printed line in pixels, a positive number as 2.4",
}
OF_SETTING = "for which value the points hold, a positive number as 0.83"
# Fewest characters of texts, of an origin of sigma as in `Series`.
LEAST = {"who": 2, "from": 3, "how": 3, "sigma_origin": 10}
PLACEHOLDER = re.compile(
    r"<.*>|\W*|x+|(your|todo|tbd)\b.*|(the )?name|who|when|from|how|none|n/a|unknown", re.I
)
# Smallest sigma of a reading, as a share of the range: a fifth of a pixel of a picture 4000 wide.
SMALLEST_SIGMA = 5e-5
# Share of the range by which the map of a picture may move a point out of it.
SLACK = 0.03
_N = NUMBER.pattern
PATTERNS = {
    "axes": re.compile(rf"{_N} to {_N}; {_N} to {_N}"),
    "marks": re.compile(rf"{_N} {_N}(; {_N} {_N}){{2,}}"),
    "sigma_values": re.compile("[1-9][0-9]{0,5}"),
    "tilt": re.compile(f"{ANY:g}|{FLAT_BED:g}"),
}


def filled(series: Mapping[str, Any], file: Path) -> dict[str, Any]:
    """The entry of an awaited series, digitised as the head of this file says."""
    asked = series.get("open", [])
    head = _head(file, WANTED | dict.fromkeys(asked, OF_SETTING))
    entry = {
        **series,
        "kind": "digitised",
        "path": str(file),
        "digitised_by": "{who}, {when}, from {from}, {how}".format(**head),
        "x": _axis(series["x"], head["sigma_x"]),
        "y": _axis(series["y"], head["sigma_y"]),
        "sigma_origin": head["sigma_origin"],
        "settings": series.get("settings", {}) | {key: float(head[key]) for key in asked},
        "calibration": _calibration(head, file),
        "overlay": _overlay(file),
    }
    if "sigma_values" in head:
        entry["sigma_values"] = int(head["sigma_values"])
    return entry


def checked(entry: Mapping[str, Any], file: Path) -> dict[str, Any]:
    """What `filled` gave, with its number of points: none with such a sigma, or there twice."""
    series, faults = Series(**entry), Faults()
    assert series.calibration is not None
    for where, axis, of_mark in zip(
        "xy", series.axes.values(), series.calibration.sigma, strict=True
    ):
        least = SMALLEST_SIGMA * (axis.range[1] - axis.range[0])
        for key, sigma in ((f"sigma_{where}", axis.sigma), (f"mark_sigma_{where}", of_mark)):
            faults += [f"{file}: {key} = {refusal}" for refusal in axis.refusals(sigma)]
            if float(sigma) < least:
                allowed = f"allowed is {least:g} or more; no picture is as fine"
                faults.append(f"{file}: {key} = {sigma:g}: {allowed}")
    faults.refuse()
    points = series.points()
    for x, y in points[points.duplicated()].to_numpy()[:1]:
        raise SourceError(f"{file}: the point {x:g}, {y:g} stands twice; the second tells nothing")
    return {**entry, "points": len(points)}


def _overlay(file: Path) -> str | None:
    """The picture of a print under our curves, which may lie beside a reading."""
    picture = file.with_suffix(".png")
    if not picture.is_file():
        return None
    if not picture.read_bytes().startswith(b"\x89PNG"):
        raise SourceError(f"{picture}: no PNG; figures/your_copy.html saves one")
    return str(picture)


def _axis(axis: Mapping[str, Any], sigma: str) -> dict[str, Any]:
    """An axis with this sigma. The map of a picture may move points farther than that."""
    low, high = axis["range"]
    return {**axis, "sigma": float(sigma), "slack": SLACK * (high - low)}


def _calibration(head: Mapping[str, str], file: Path) -> Calibration:
    """How the axes were found, from a head whose values have their patterns."""

    def pairs(key: str) -> tuple[Any, ...]:
        every = head[key].replace(" to ", " ").split(";")
        return tuple(tuple(map(float, pair.split())) for pair in every)

    found = Calibration(
        axes=pairs("axes"),
        marks=pairs("marks"),
        sigma=(float(head["mark_sigma_x"]), float(head["mark_sigma_y"])),
        tilt=float(head.get("tilt", ANY)),
        is_line="line_width" in head,
    )
    if any(first >= last for first, last in found.axes):
        raise SourceError(f"{file}: axes = {head['axes']}: the first value must be the smaller")
    if not found.fixes(6):
        raise SourceError(f"{file}: marks = {head['marks']}: they lie on one line")
    if found.tilt > FLAT_BED and not found.fixes(8):
        raise SourceError(
            f"{file}: marks = {head['marks']}: needed are four with the corner opposite the "
            f"origin, or three on each axis; fewer with `# tilt: {FLAT_BED:g}`, a flat-bed scan"
        )
    return found


def _head(file: Path, wanted: Mapping[str, str]) -> dict[str, str]:
    """Values of a head, which has these keys; all that is wrong in it is told at once."""
    allowed, head, faults = {**wanted, **MORE}, {}, Faults()
    for number, line in enumerate(head_and_table(text_of(file))[0], 1):
        # Excel puts quotes around a line that has commas, and commas behind one that has few.
        key, colon, value = map(str.strip, line.strip('", \t\r\n').lstrip("# \t").partition(":"))
        problem = ""
        if key == "series" and value != f"{file.parent.name}/{file.stem}":
            belongs = ascii(f"{value}; it belongs to data/{value}.csv")[1:-1]
            problem = f"this is a reading of {belongs}"
        elif key in head:
            problem = f"{key} stands twice"
        elif colon and key not in allowed:
            problem = f"{shown(key)} is no key of a head; allowed are {', '.join(allowed)}"
        elif colon and key != "series" and not _is_admissible(key, value):
            problem = f"{key} = {shown(value)}; needed is {allowed[key]}"
        if problem:
            faults.append(f"{file}, line {number}: {problem}")
        if colon:
            head[key] = value.replace("$", "")  # which begins a formula on the pages
    if not head:
        raise SourceError(
            f"{file}: lines as `# who: Ada Reader` are missing above the table, with "
            f"{', '.join(wanted)}; figures/your_copy.html writes them"
        )
    missing = {key: what for key, what in wanted.items() if key not in head}.items()
    faults += [f"{file}: a line `# {key}:` is missing; needed is {what}" for key, what in missing]
    faults.refuse()
    return head


def _is_admissible(key: str, value: str) -> bool:
    if key in LEAST:
        return len(value) >= LEAST[key] and not PLACEHOLDER.fullmatch(value)
    if key in PATTERNS:
        return bool(PATTERNS[key].fullmatch(value))
    if key != "when":
        return bool(NUMBER.fullmatch(value)) and 0 < float(value) < math.inf
    # The day begins there first: a reader may be ahead of this computer.
    first = datetime.timezone(datetime.timedelta(hours=14))
    try:
        day = datetime.date.fromisoformat(value)
    except ValueError:
        return False
    return f"{day}" == value and day <= datetime.datetime.now(first).date()
