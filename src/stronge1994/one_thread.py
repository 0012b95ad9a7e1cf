"""Keep numerical libraries to one thread.

Import this module before numpy: the libraries look at these variables only when they are loaded.
Without it they would use all threads of a rule. Rules that measure time ask for all threads, but
only so that nothing else runs meanwhile.
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
