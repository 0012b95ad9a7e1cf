"""The reference data in data/: loaded and checked, or refused with a line for each fault.

A source is a folder with `source.yaml`, a `Source`, and one CSV for each series; that of an awaited
one may be missing, and has a head if it is there.
"""

import re
from pathlib import Path
from typing import Any, TypeAlias

from stronge1994.reference_data import formats, reading
from stronge1994.reference_data.formats import (
    Faults,
    SourceError,
    load_yaml,
    refuse_invalid,
    text_of,
)
from stronge1994.reference_data.series import LARGEST_SIGMA, Axis, Fact, Series, Source

__all__ = [
    "LARGEST_SIGMA",
    "Axis",
    "Fact",
    "Faults",
    "Inventory",
    "Series",
    "SourceError",
    "load",
    "load_all",
    "load_yaml",
    "reference",
    "refuse_invalid",
    "text_of",
]

# Contents of a source.yaml; a loaded series also has its `path`.
Inventory: TypeAlias = dict[str, Any]

# Folders of data/ with tables of impacts, and with what was accepted of a run.
NO_SOURCES = {"scenes", "accepted"}
# Files that other programs leave: those of desktops, and older versions.
LEFT = re.compile(r"[.].*|README.*|desktop[.]ini|thumbs[.]db|~[$].*|.*(~|[.]bak)", re.I)


def load(folder: Path) -> dict[str, Any]:
    """Load and check a folder of data/.

    Each series gets the parameters of the source, and its `path`, None while awaited. An awaited
    series whose file is there becomes `digitised`, with what the head of the file says.
    """
    path = folder / "source.yaml"
    stated = load_yaml(path)
    source, names, faults = formats.read(Source, stated, path), _visible(folder), Faults()
    for name, series in source.series.items():
        file, entry = folder / f"{name}.csv", stated["series"][name]
        entry["path"] = None
        entry["parameters"] = {key: one.value for key, one in source.parameters.items()}
        with faults:
            if series.kind != "awaited":
                entry["path"] = str(file)
                count = len(Series(**entry).points())
                if count != series.count:
                    where = f"{path}: series.{name}.points = {series.count}"
                    faults.append(f"{where}: {file} has {count} points")
            elif file.name in names:
                stated["series"][name] = reading.checked(reading.filled(entry, file), file)
    for name in source.made_with:
        if not (folder / name).is_file():
            faults.append(f"{folder / name}: missing, and {path} says it is there")
    # A ledger or the program that computes a series may lie there. Any other file that is not in
    # `made_with` is refused: it may be a table with a wrong name, which would silently be ignored.
    own = {f"{name}.csv" for name in source.series}
    pictures = {f"{name}.png" for name in source.series}  # of readings, from figures/your_copy.html
    for name in sorted(names - own - pictures - {"source.yaml", *source.made_with}):
        if not name.endswith((".yaml", ".py")):
            allowed = ", ".join(sorted(own)) or "none"
            faults.append(f"{folder / name}: no series of that name; allowed are {allowed}")
    faults.refuse()
    return stated


def _visible(folder: Path) -> set[str]:
    """Names in a folder, without READMEs, hidden files and what other programs leave."""
    return {path.name for path in folder.iterdir() if not LEFT.fullmatch(path.name)}


def load_all(data: str | Path) -> Inventory:
    """Load every source in the folder `data`: `{source: contents}`. `NO_SOURCES` are none."""
    found, faults = {}, Faults()
    for folder in [Path(data, name) for name in sorted(_visible(Path(data)) - NO_SOURCES)]:
        with faults:
            if not (folder / "source.yaml").is_file():
                raise SourceError(f"{folder}: no source: allowed are folders with a source.yaml")
            found[folder.name] = load(folder)
    faults.refuse()
    return found


def reference(inventory: Inventory, name: str, where: str = "reference") -> Series | Fact:
    """The series or the fact that `source/entry` names."""
    source, _, entry = f"{name}".partition("/")
    stated = inventory.get(source, {})
    known = stated.get("series", {}) | stated.get("facts", {})
    if entry in known:
        kind = Series if entry in stated.get("series", {}) else Fact
        return kind(**{**known[entry], "name": name})
    allowed = ", ".join([f"{source}/{one}" for one in known] or inventory)
    problem = f"{name!a} is neither a series nor a fact in data/; allowed are {allowed}"
    raise SourceError(f"{where}: {problem}")
