"""The table of what running the ledger's entries found."""

from collections import Counter

COLUMNS = [
    "kind", "entry", "holds", "verdict", "where", "says", "test", "found", "confirms", "between",
    "corrected", "problem", "reading", "range", "correction", "derivation", "why",
]  # fmt: skip


def failing(rows):
    """Rows whose recorded verdict no longer holds."""
    return [row for row in rows if row["holds"] == "no"]


def summary(rows):
    """Lines for a terminal: counts, and each entry that no longer holds with its reason."""
    counts = Counter(row["verdict"] for row in rows)
    bad = failing(rows)
    words = ", ".join(f"{count} {verdict}" for verdict, count in counts.items())
    lines = [f"ledger of the paper: {words}; {len(bad)} no longer hold"]
    for row in bad:
        lines.append(f"  no longer holds: {row['entry']} ({row['where']}): {row['problem']}")
    return "\n".join(lines)
