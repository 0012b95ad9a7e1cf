"""Times of blocks of code, and whether the machine was busy while they were taken."""

import functools
import time

import numpy as np

# Wall time over CPU time beyond which the machine counts as busy. A time is then a fifth too long,
# more than it changes from run to run. A quiet machine stays below 1.05; with as many other jobs as
# cores it is 1.5 and more.
BUSY = 1.2


class Watch:
    """Wall and CPU time of blocks of code, to see whether the machine gave them a whole core.

    `wall` and `cpu` hold the seconds of each block.

    >>> watch = Watch()
    >>> with watch:
    ...     time.sleep(0.1)
    >>> watch.over_cpu() > BUSY  # the process slept
    True
    """

    def __init__(self) -> None:
        self.wall: list[float] = []
        self.cpu: list[float] = []

    def __enter__(self) -> None:
        # The CPU clock is read first and last, so that its time covers the whole block.
        self._start = time.process_time(), time.perf_counter()

    def __exit__(self, *_: object) -> None:
        self.wall.append(time.perf_counter() - self._start[1])
        self.cpu.append(time.process_time() - self._start[0])

    def over_cpu(self) -> float:
        """Median wall time over median CPU time.

        The operating system interrupts few calls that are shorter than its slice of time, so their
        median is right under any load. Calls shorter than a tick of the CPU clock show up to one
        tick too little CPU time, so one tick is added.
        """
        return float(np.median(self.wall) / (np.median(self.cpu) + _tick()))


@functools.cache
def _tick() -> float:
    """Step of the CPU clock, measured, as some systems state a finer one than they have."""
    start = now = time.process_time()
    while now == start:
        now = time.process_time()
    return now - start
