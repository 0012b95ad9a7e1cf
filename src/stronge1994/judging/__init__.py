"""Judge a run: how far each table is from its references, and whether that is allowed.

`compare` gives the rows of one table. It has three parts: `measure` finds distances, `judge` turns
them into a verdict, and `rows` writes both into tables. `verdict_table` gathers the rows of a run.
"""

from stronge1994.judging.metrics import Measured, measure
from stronge1994.judging.rows import compare, write
from stronge1994.judging.verdicts import Verdict, judge

__all__ = ["Measured", "Verdict", "compare", "judge", "measure", "write"]
