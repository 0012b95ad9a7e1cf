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

from planarimpact.ground.checks import InputError
from planarimpact.scene import writing
from planarimpact.scene.reading import Piece
from planarimpact.scene.solver import Solver
from planarimpact.scene.writing import Encoded

# Pieces that wait for each worker, so that it has the next one when it is ready.
AHEAD = 2


class Task(NamedTuple):
    """How pieces are solved, as in `files.solve`, and the kind of the file that is written.

    A piece for which the continuum is solved more than `part` times is cut.
    """

    tolerance: float
    loss: str | None
    skip_bad: bool
    kind: str
    part: int


class Done(NamedTuple):
    """The content of the file for a piece, the share that is read by then, and its solver."""

    share: float | None
    content: Encoded
    solver: Solver


class Cut(NamedTuple):
    """Where a piece is cut because it takes long, the shares that are read before it and by then.

    `words` say why it takes long.
    """

    cuts: list[int]
    since: float | None
    share: float | None
    words: str


def solved(task: Task, piece: Piece, whole: bool = False) -> Done | Cut:
    """Solve a piece, or say where to cut it, unless it shall be solved as a whole."""
    solver = Solver(task.tolerance, task.loss)
    solver.rows = piece.before
    block = solver.read(piece.table(), task.skip_bad)
    if not whole and (cuts := block.cuts(task.part)):
        words = f"rows {piece.before + 1:,} to {solver.rows + len(block.table):,}: "
        return Cut(cuts, piece.since, piece.share, words + block.leave_the_table())
    after = solver.answer(block, task.skip_bad)
    # A column has one type in all pieces, whatever a piece has in it.
    names = block.names
    kinds = {names[name]: float for name in names.keys() - {"loss"}}
    content = writing.encoded(after.astype(kinds), task.kind, header=piece.before == 0)
    return Done(piece.share, content, solver)


def solved_here(task: Task, pieces: Iterator[Piece]) -> Iterator[Done | Cut]:
    """Solve pieces in this process. The result of a piece that is cut comes before its parts."""
    for piece in pieces:
        result = solved(task, piece)
        yield result
        if isinstance(result, Cut):
            yield from (solved(task, part, True) for part in piece.parts(result.cuts))


def solved_by_workers(task: Task, pieces: Iterator[Piece], count: int) -> Iterator[Done | Cut]:
    """As `solved_here`, by several workers.

    The results have the order of the pieces. So have the refusals, those of `pieces` among them:
    the first one is raised.
    """
    context = multiprocessing.get_context("spawn")
    waiting: deque[tuple[Piece | None, Future[Done | Cut]]] = deque()
    with ProcessPoolExecutor(count, context, initializer=_end_with_parent) as pool:

        def results(most: int) -> Iterator[Done | Cut]:
            """The first results, until no more than `most` wait."""
            while len(waiting) > most:
                piece, future = waiting.popleft()
                result = future.result()
                yield result
                if piece and isinstance(result, Cut):
                    parts = [
                        (part, _submit(pool, task, part, True)) for part in piece.parts(result.cuts)
                    ]
                    waiting.extendleft(reversed(parts))

        try:
            for piece_and_future in _submitted(pool, task, pieces):
                waiting.append(piece_and_future)
                yield from results(AHEAD * count)
            yield from results(0)
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


def _submit(
    pool: ProcessPoolExecutor, task: Task, piece: Piece, whole: bool = False
) -> Future[Done | Cut]:
    with _signals_held():  # a worker may start
        return pool.submit(solved, task, piece, whole)


def _submitted(
    pool: ProcessPoolExecutor, task: Task, pieces: Iterator[Piece]
) -> Iterator[tuple[Piece | None, Future[Done | Cut]]]:
    """Pieces and futures of their results; what cannot be read is a future that failed."""
    try:
        for piece in pieces:
            yield piece, _submit(pool, task, piece)
    except (InputError, OSError) as error:
        failed: Future[Done | Cut] = Future()
        failed.set_exception(error)
        yield None, failed


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
        for number in (int(signal.SIGINT), int(signal.SIGTERM))
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
