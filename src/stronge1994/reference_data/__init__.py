"""The reference data in data/: loaded and checked, or refused with one clear message.

A source is a folder with `source.yaml` (schema: workflow/schemas/source.schema.yaml) and one CSV
for each series; that of an awaited one may be missing, and has a head if it is there.
"""

import copy
import functools
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, TypeAlias

from planarimpact.common import checks
from stronge1994.reference_data import reading, strict_yaml
from stronge1994.reference_data.series import (
    Axis,
    Fact,
    Series,
    SourceError,
    of,
    text_of,
)
from stronge1994.tables import Table

__all__ = [
    "Axis",
    "Fact",
    "Series",
    "SourceError",
    "load",
    "load_all",
    "load_yaml",
    "of",
    "refuse_invalid",
    "text_of",
]

# Contents of a source.yaml; a loaded series also has its `path`.
Source: TypeAlias = dict[str, Any]
Schema: TypeAlias = Mapping[str, Any]

# Folders of data/ with tables of impacts, and with what was accepted of a run.
NO_SOURCES = {"scenes", "accepted"}
# Largest sigma, as a share of the range of its axis. The series here have a tenth to a half of it.
# A measured series may have a larger one: that is how it was measured.
LARGEST_SIGMA = 0.01
# Smallest one of a reading: a fifth of a pixel of a picture 4000 pixels wide.
SMALLEST_SIGMA = 5e-5


def _ascends(_: Any, wanted: bool, numbers: Any, schema: Schema) -> Iterator[Exception]:
    """The keyword `ascending` of our schemas."""
    import jsonschema

    items = numbers if isinstance(numbers, list) else []
    are_numbers = all(isinstance(number, int | float) for number in items)
    if wanted and are_numbers and sorted(set(items)) != items:
        yield jsonschema.ValidationError(f"{numbers}: each number must be larger than that before")


@functools.cache
def _validator() -> Any:
    """Class of validators. JSON Schema takes 2.0 for an integer, range() refuses it; so do we."""
    import jsonschema  # slow to load, and jobs that only name columns do without it

    draft = jsonschema.Draft202012Validator
    types = draft.TYPE_CHECKER.redefine(
        "integer", lambda _, value: isinstance(value, int) and not isinstance(value, bool)
    )
    return jsonschema.validators.extend(draft, {"ascending": _ascends}, type_checker=types)


def load(folder: Path, schema: Schema) -> Source:
    """Load and check a folder of data/; each series gets its `path`, None while awaited.

    An awaited series whose file is there becomes `digitised`, with what the head of the file says.
    """
    path = folder / "source.yaml"
    source = load_yaml(path)
    refuse_invalid(source, schema, path)
    every, names = source.get("series", {}), _visible(folder)
    for name, series in every.items():
        file = folder / f"{name}.csv"
        for where, axis in Series(**series).axes.items():
            _refuse_axis(f"{path}: series.{name}.{where}", axis, series["kind"])
        series["path"] = None
        if series["kind"] == "awaited" and file.name in names:
            every[name] = read = reading.filled(series, file)
            read["points"] = len(_read_points(Series(**read), file))
            read["overlay"] = _overlay(file) if file.with_suffix(".png").name in names else None
        elif series["kind"] != "awaited":
            series["path"] = str(file)
            count = len(Series(**series).points())
            if count != series.get("points"):
                where = f"{path}: series.{name}.points = {series.get('points')}"
                raise SourceError(f"{where}: {series['path']} has {count} points")
    own = {f"{name}.csv" for name in every}
    pictures = {f"{name}.png" for name in every}  # of readings, from figures/your_copy.html
    known = {"source.yaml", *own, *pictures, *source.get("made_with", [])}
    for name in source.get("made_with", []):
        if not (folder / name).is_file():
            raise SourceError(f"{folder / name}: missing, and {path} says it is there")
    # A ledger or the program that computes a series may lie there. Any other file that is not in
    # `made_with` is refused: it may be a table with a wrong name, which would silently be ignored.
    strays = sorted(name for name in names - known if not name.endswith((".yaml", ".py")))
    if strays:
        allowed = ", ".join(sorted(own)) or "none"
        raise SourceError(f"{folder / strays[0]}: no series of that name; allowed are {allowed}")
    return source


def _visible(folder: Path) -> set[str]:
    """Names in a folder, without hidden files and READMEs."""
    return {path.name for path in folder.iterdir() if not path.name.startswith((".", "README"))}


def _refuse_axis(where: str, axis: Axis, kind: str) -> None:
    """Refuse an axis whose numbers contradict each other, which a schema cannot see."""
    low, high = axis.range
    if not low < high:
        raise SourceError(
            f"{where}.range = [{low:g}, {high:g}]: the first number must be the smaller"
        )
    if not (isinstance(axis.sigma, str) or kind == "measured"):
        _refuse_sigma(f"{where}.sigma", float(axis.sigma), axis)


def _read_points(series: Series, file: Path) -> Table:
    """The points of a reading, refused if they cannot be one: with such sigmas, or two times."""
    known = series.calibration
    assert known is not None
    for where, axis, of_mark in zip("xy", series.axes.values(), known.sigma, strict=True):
        low, high = axis.range
        for key, sigma in ((f"sigma_{where}", axis.sigma), (f"mark_sigma_{where}", of_mark)):
            _refuse_sigma(f"{file}: {key}", float(sigma), axis)
            if (least := SMALLEST_SIGMA * (high - low)) > float(sigma):
                allowed = f"allowed is {least:g} or more; no picture is as fine"
                raise SourceError(f"{file}: {key} = {sigma:g}: {allowed}")
    points = series.points()
    twice = points[points.duplicated()]
    if len(twice):
        x, y = twice.iloc[0]
        raise SourceError(f"{file}: the point {x:g}, {y:g} stands twice; the second tells nothing")
    return points


def _overlay(file: Path) -> str:
    """The picture of a print under our curves, which lies beside a reading."""
    picture = file.with_suffix(".png")
    if not picture.read_bytes().startswith(b"\x89PNG"):
        raise SourceError(f"{picture}: no PNG; figures/your_copy.html saves one")
    return str(picture)


def _refuse_sigma(where: str, sigma: float, axis: Axis) -> None:
    """Refuse a sigma with which points would judge nothing."""
    low, high = axis.range
    most = LARGEST_SIGMA * (high - low)
    if sigma > most:
        raise SourceError(
            f"{where} = {sigma:g}: allowed is up to {most:g}, a hundredth of the "
            f"range {low:g} to {high:g}; with more the series would judge nothing"
        )


def load_yaml(path: str | Path) -> dict[str, Any]:
    """Read a YAML file: a mapping whose keys are texts; a `SourceError` names file and line."""
    try:
        return copy.deepcopy(_parsed(text_of(path)))
    except ValueError as error:
        raise SourceError(f"{path}, {error}") from None


_parsed = functools.cache(strict_yaml.load)  # a start reads some files twice


def load_all(data: str | Path, schema: Schema) -> dict[str, Source]:
    """Load every source in the folder `data`: `{source: contents}`. `NO_SOURCES` are none."""
    folders = [Path(data, name) for name in sorted(_visible(Path(data)) - NO_SOURCES)]
    for folder in folders:
        if not (folder / "source.yaml").is_file():
            raise SourceError(f"{folder}: no source: allowed are folders with a source.yaml")
    return {folder.name: load(folder, schema) for folder in folders}


def refuse_invalid(document: Any, schema: Schema, name: str | Path) -> None:
    """Refuse a document that its schema does not admit, saying where and what."""
    errors = sorted(
        _validator()(schema).iter_errors(document), key=lambda e: [str(p) for p in e.path]
    )
    if errors:
        where = ".".join(map(str, errors[0].path)) or "top level"
        broken = errors[0].schema if isinstance(errors[0].schema, dict) else {}  # else a bool
        known = broken.get("properties", {})
        allowed = f"; allowed are {', '.join(known)}" if "unexpected" in errors[0].message else ""
        if errors[0].validator == "minLength":
            allowed = f"; allowed are texts of {errors[0].validator_value} characters or more"
        message = checks.in_ascii(f"{where}: {errors[0].message}")
        raise SourceError(f"{name}: {message}{allowed}")
