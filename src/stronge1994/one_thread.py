"""Keep numerical libraries to one thread. Import it before numpy: they look only when loaded.

Snakemake offers them all threads of a rule, and a rule that measures time takes all, but only so
that nothing runs beside it.
"""

import os

LIMITS = (
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "GOTO_NUM_THREADS",
    "MKL_NUM_THREADS",
    "NUMEXPR_NUM_THREADS",
    "VECLIB_MAXIMUM_THREADS",
)
os.environ.update(dict.fromkeys(LIMITS, "1"))
