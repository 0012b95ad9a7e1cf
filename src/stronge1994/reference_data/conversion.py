"""Bring the series of one source into one table with its own column names."""

from stronge1994 import csv_tables, reference_data
from stronge1994.reference_data import Source


def convert(source: Source, output: str) -> None:
    """Write every series of a loaded `source` that is not awaited."""
    tables = {
        name: reference_data.read_series(name, series)
        for name, series in source["series"].items()
        if series["path"]
    }
    csv_tables.write(output, tables, first="series")
    for name, columns in tables.items():
        print(f"{name}: {len(next(iter(columns.values())))} points")
