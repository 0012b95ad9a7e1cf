"""Judge a run: how far each table is from its references, and whether that is allowed.

`compare` gives the rows of one table. It has three parts: `metrics` finds distances, `verdicts`
turns them into a verdict, and `rows` writes both into tables.
"""

from stronge1994.judging.rows import compare, write

__all__ = ["compare", "write"]
