"""The verdicts of a run as one table, worst first, for files and for the terminal."""

from collections import Counter

import csv_tables

ORDER = ["diverges", "differs as documented", "awaited", "agrees"]


def gather(paths):
    """Rows of several tables, worst verdict first, else in the order of the figures."""
    rows = [row for path in paths for row in csv_tables.read_rows(path)]
    return sorted(rows, key=lambda row: ORDER.index(row["verdict"]))


def failing(rows):
    """Rows that fail a run."""
    return [row for row in rows if row["verdict"] == "diverges"]


def text(rows):
    """The table for a terminal; the note of a failing row is written out below it."""
    lines = [f"{'verdict':<21} {'comparison':<35} {'measured':<27} {'allowed':<27} note"]
    lines.append("-" * 130)
    for row in rows:
        note = row["note"] if row["verdict"] != "diverges" else ""
        lines.append(
            f"{row['verdict']:<21} {row['comparison']:<35} {_measured(row):<27} "
            f"{row['allowed']:<27} {note}".rstrip()
        )
        if row["verdict"] == "diverges" and row["note"]:
            lines.append(f"{'':<21} {row['note']}")
    counts = Counter(row["verdict"] for row in rows)
    lines.append("-" * 130)
    lines.append(", ".join(f"{counts[v]} {v}" for v in ORDER if counts[v]))
    return "\n".join(lines)


def _measured(row):
    if row["found"]:
        return f"{row['found']} (stated {row['stated']})"
    return f"rms {row['rms [sigma]']}, max {row['max [sigma]']}" if row["points"] else ""
