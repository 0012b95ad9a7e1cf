"""The reference data in data/: loaded, checked and refused with one clear message.

A source is a folder with `source.yaml` (schema: workflow/schemas/source.schema.yaml) and one CSV
a series. An awaited series becomes digitised when WebPlotDigitizer's export is dropped into the
folder as `<series>.wpd.csv` and `digitised_by` in source.yaml says whose work it is.
"""

import csv
import math
from pathlib import Path

import jsonschema
import yaml

# For JSON Schema 2.0 is an integer; for range() it is not.
_Validator = jsonschema.validators.extend(
    jsonschema.Draft202012Validator,
    type_checker=jsonschema.Draft202012Validator.TYPE_CHECKER.redefine(
        "integer", lambda _, value: isinstance(value, int) and not isinstance(value, bool)
    ),
)


class SourceError(Exception):
    """Something in data/ is not as source.yaml or its schema says."""


def load(folder, schema):
    """Load and check one source.

    Parameters
    ----------
    folder : Path
        data/<source>.
    schema : dict
        The schema of source.yaml.

    Returns
    -------
    dict
        Contents of source.yaml; each series with its `path` (None while awaited).

    Raises
    ------
    SourceError
        Naming file, line, column and value.
    """
    path = folder / "source.yaml"
    source = load_yaml(path)
    refuse_invalid(source, schema, path)
    for name, series in source.get("series", {}).items():
        series["path"] = _file_of(folder, name, series)
        if series["path"]:
            read_series(name, series)
    known = {"source.yaml", *(Path(s["path"]).name for s in _found(source))}
    strays = sorted(file.name for file in folder.glob("*.csv") if file.name not in known)
    if strays:
        names = ", ".join(source.get("series", {})) or "none"
        raise SourceError(f"{folder / strays[0]}: no series of that name; source.yaml has {names}")
    return source


class _UniqueKeys(yaml.SafeLoader):
    """Refuses what YAML lets pass: of two equal keys the first is lost without a word."""

    def construct_mapping(self, node, deep=False):
        names = [key.value for key, _ in node.value]
        for key, _ in node.value:
            if names.count(key.value) > 1:
                self._refuse(key, "stands twice")
            if key.tag not in ("tag:yaml.org,2002:str", "tag:yaml.org,2002:merge"):
                self._refuse(key, "is no text")
        return super().construct_mapping(node, deep)

    @staticmethod
    def _refuse(key, what):
        message = f"the key '{key.value}' {what}"
        raise yaml.constructor.ConstructorError(None, None, message, key.start_mark)


def load_yaml(path):
    """Read a YAML file whose keys are texts, each once.

    Raises
    ------
    SourceError
        Naming the file, and the line where there is one.
    """
    try:
        return yaml.load(Path(path).read_text(encoding="utf-8"), Loader=_UniqueKeys)
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise SourceError(f"{path}: {error}") from None


def load_all(data, schema):
    """Load every source below the folder `data`: `{source: contents}`."""
    folders = sorted(path.parent for path in Path(data).glob("*/source.yaml"))
    return {folder.name: load(folder, schema) for folder in folders}


def refuse_invalid(document, schema, name):
    """Refuse a document that its schema does not admit, saying where and what."""
    errors = sorted(
        _Validator(schema).iter_errors(document), key=lambda e: [str(p) for p in e.path]
    )
    if errors:
        where = ".".join(map(str, errors[0].path)) or "top level"
        raise SourceError(f"{name}: {where}: {errors[0].message}")
    for where, value in _leaves(document):
        if isinstance(value, float) and not math.isfinite(value):
            raise SourceError(f"{name}: {where}: {value} is not a finite number")


def _leaves(node, where=""):
    """Every value of a document with its dotted path."""
    if isinstance(node, (dict, list)):
        for key, value in node.items() if isinstance(node, dict) else enumerate(node):
            yield from _leaves(value, f"{where}.{key}" if where else f"{key}")
    else:
        yield where, node


def column_name(axis):
    """Column header of an axis, unit in brackets."""
    return f"{axis['column']} [{axis['unit']}]"


def read_series(name, series):
    """Read one series, checked: `{column: list}` with numbers on both axes, words as labels."""
    path = Path(series["path"])
    labels = series.get("labels", [])
    axes = {column_name(series[axis]): series[axis] for axis in ("x", "y")}
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:
            rows = list(csv.reader(file))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise SourceError(f"{path}: not a readable CSV: {error}") from None
    if series["kind"] == "awaited":
        header, rows = list(axes), _digitiser_rows(path, name, rows)
    else:
        header, rows = (rows or [[]])[0], list(enumerate(rows[1:], start=2))
    missing = [column for column in [*labels, *axes] if column not in header]
    if missing:
        raise SourceError(f"{path}: column '{missing[0]}' is missing; found {', '.join(header)}")
    if not rows:
        raise SourceError(f"{path}: no points")
    columns = {column: [] for column in [*labels, *axes]}
    for line, row in rows:
        if len(row) != len(header):
            raise SourceError(f"{path}, line {line}: {len(row)} cells where {len(header)} belong")
        for column in columns:
            cell = row[header.index(column)]
            where = f"{path}, line {line}, column '{column}'"
            columns[column].append(_number(cell, axes[column], where) if column in axes else cell)
    return columns


def _number(cell, axis, where):
    low, high = axis["range"]
    try:
        value = float(cell)
    except ValueError:
        raise SourceError(f"{where}: '{cell}' is not a number") from None
    if not (math.isfinite(value) and low <= value <= high):
        raise SourceError(f"{where}: {cell} is outside {low:g} to {high:g}")
    return value


def _found(source):
    return [series for series in source.get("series", {}).values() if series["path"]]


def _file_of(folder, name, series):
    """Path of a series; None for an awaited one whose export is not there."""
    if series["kind"] != "awaited":
        path = folder / f"{name}.csv"
        if not path.is_file():
            raise SourceError(f"{path}: missing, and {folder / 'source.yaml'} says it is there")
        return str(path)
    path = folder / f"{name}.wpd.csv"
    if not path.is_file():
        return None
    if not series["digitised_by"]:
        raise SourceError(
            f"{path}: whose work? Fill series.{name}.digitised_by in {folder / 'source.yaml'} "
            "(who, when, with what)"
        )
    return str(path)


def _digitiser_rows(path, name, rows):
    """Points of a WebPlotDigitizer export: one dataset, or all of them under two header lines."""
    start = 0
    if rows and len(rows) > 1 and [cell.strip() for cell in rows[1][:2]] == ["X", "Y"]:
        datasets = [cell.strip() for cell in rows[0][::2]]
        if len(datasets) > 1 and name not in datasets:
            raise SourceError(
                f"{path}: several datasets ({', '.join(datasets)}); call one '{name}', or export "
                "one alone"
            )
        start = 2 * (datasets.index(name) if name in datasets else 0)
        rows = [[], [], *rows[2:]]
    points = [(line, row[start : start + 2]) for line, row in enumerate(rows, start=1)]
    return [(line, row) for line, row in points if any(cell.strip() for cell in row)]
