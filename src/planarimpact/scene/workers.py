"""Pieces of a scene solved one after the other: in this process, or by several workers."""

import multiprocessing
import os
import signal
import threading
from collections import deque
from collections.abc import Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from multiprocessing import resource_tracker
from typing import NamedTuple

from planarimpact.ground import files
from planarimpact.ground.checks import InputError
from planarimpact.scene import columns, writing
from planarimpact.scene.reading import Piece
from planarimpact.scene.solver import Solver
from planarimpact.scene.writing import Encoded

# Pieces that wait for each worker, so that it has the next one when it is ready.
AHEAD = 2


class Task(NamedTuple):
    """How pieces are solved, as in `files.solve`, and the kind of the file that is written."""

    tolerance: float
    loss: str | None
    skip_bad: bool
    kind: str


class Done(NamedTuple):
    """The content of the file for a piece, the share that is read by then, and its solver."""

    share: float | None
    content: Encoded
    solver: Solver


def solved(task: Task, piece: Piece) -> Done:
    """Solve a piece."""
    solver = Solver(task.tolerance, task.loss)
    solver.rows = piece.before
    table = piece.table()
    names = columns.named(table.columns)
    after = solver.solve(table, task.skip_bad)
    # A column has one type in all pieces, whatever a piece has in it.
    kinds = {names[name]: float for name in (names.keys() & columns.KNOWN) - {"loss"}}
    content = writing.encoded(after.astype(kinds), task.kind, header=piece.before == 0)
    return Done(piece.share, content, solver)


def solved_by_workers(task: Task, pieces: Iterator[Piece], count: int) -> Iterator[Done]:
    """Solve pieces by several workers.

    The results have the order of the pieces. So have the refusals, those of `pieces` among them:
    the first one is raised.
    """
    context = multiprocessing.get_context("spawn")
    waiting: deque[Future[Done]] = deque()
    with ProcessPoolExecutor(count, context, initializer=_end_with_parent) as pool:
        try:
            for future in _submitted(pool, task, pieces):
                waiting.append(future)
                if len(waiting) > AHEAD * count:
                    yield waiting.popleft().result()
            while waiting:
                yield waiting.popleft().result()
        except BrokenProcessPool:
            raise InputError(
                "a worker ended before its work was done: it may lack memory, which fewer workers "
                "need less of, or standard error has its last words"
            ) from None
        except BaseException:
            # Otherwise the pool would wait for the pieces that are being solved.
            for process in pool._processes.values():
                process.kill()
            raise


def _submitted(
    pool: ProcessPoolExecutor, task: Task, pieces: Iterator[Piece]
) -> Iterator[Future[Done]]:
    """Futures of the results; a piece that cannot be read is a future that failed."""
    try:
        for piece in pieces:
            with _signals_held():  # a worker may start
                future = pool.submit(solved, task, piece)
            yield future
    except (InputError, OSError) as error:
        failed: Future[Done] = Future()
        failed.set_exception(error)
        yield failed


@contextmanager
def _signals_held() -> Iterator[None]:
    """Hold back signals that end this process; a worker that starts in the block gets no Ctrl-C.

    Otherwise a worker might start that the pool does not know yet. Only the main thread gets
    signals.
    """
    main = threading.current_thread() is threading.main_thread()
    if not main or not hasattr(signal, "pthread_sigmask"):
        yield
        return
    arrived: list[int] = []
    handlers = {
        number: signal.signal(number, lambda number, frame: arrived.append(number))
        for number in files.SIGNALS
        if callable(signal.getsignal(number))
    }
    resource_tracker.ensure_running()  # it belongs to the pool, and would end the mask
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})  # workers inherit it
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        for number, handler in handlers.items():
            signal.signal(number, handler)
        for number in arrived[:1]:
            signal.raise_signal(number)


def _end_with_parent() -> None:
    """Make this worker end when the process that started it ends, however that may be."""

    def wait() -> None:
        parent = multiprocessing.parent_process()
        if parent:
            parent.join()
            os._exit(1)

    threading.Thread(target=wait, daemon=True).start()
