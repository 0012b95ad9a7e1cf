"""Pieces of a scene solved one after the other: in this process, or by several workers.

A worker is a process of its own. It gets pieces on its standard input and answers on its standard
output, as pickles, until its input ends. So no worker outlives the process that started it. Each
gets every n-th piece: the result depends on their number, but not on their speed.
"""

import os
import pickle
import subprocess
import sys
from collections import deque
from collections.abc import Generator, Iterator
from concurrent.futures import Future
from queue import SimpleQueue
from threading import Thread
from typing import Any, NamedTuple

from planarimpact.ground.checks import ConvergenceError, InputError
from planarimpact.scene import columns, reading, writing
from planarimpact.scene.reading import Piece
from planarimpact.scene.solver import Solver
from planarimpact.scene.writing import Encoded

# A worker that speaks to the process that started it.
COMMAND = "from planarimpact.scene import workers; workers.serve()"
# Pieces that a worker is given at a time: it solves one while the next one is ready.
AHEAD = 2


class Task(NamedTuple):
    """What is done with pieces: as in `files.solve`, and the kind of the file that is written."""

    tolerance: float
    loss: str | None
    skip_bad: bool
    kind: str

    def solver(self) -> Solver:
        """A solver for all pieces of a process."""
        return Solver(self.tolerance, self.loss)

    def done(self, piece: Piece, solver: Solver) -> Encoded:
        """What stands in the file for a piece."""
        solver.rows = piece.before
        table = reading.table(piece.content)
        names = columns.named(table.columns)
        found = solver.solve(table, self.skip_bad)
        del table  # the result has it all
        # A column has one type in all pieces, whatever a piece has in it.
        kinds = {names[name]: float for name in (names.keys() & columns.KNOWN) - {"loss"}}
        return writing.encoded(found.astype(kinds), self.kind, header=piece.before == 0)


class Done(NamedTuple):
    """What stands in the file for a piece, the share that is read by then, and the rows."""

    share: float | None
    rows: int
    content: Encoded


def here(task: Task, solver: Solver, pieces: Iterator[Piece]) -> Iterator[Done]:
    """Solve pieces in this process."""
    for piece in pieces:
        yield Done(piece.share, piece.before + piece.rows, task.done(piece, solver))


def elsewhere(
    task: Task, solver: Solver, pieces: Iterator[Piece], count: int
) -> Generator[Done, None, None]:
    """Solve pieces by several workers.

    Parameters
    ----------
    task : Task
    solver : Solver
        Gets what the solvers of the workers remember, when all is done.
    pieces : iterator of Piece
    count : int
        Of workers, at most.

    Yields
    ------
    Done
        In the order of the pieces.

    Raises
    ------
    InputError, ConvergenceError
        The first, in the order of the pieces, of those that a worker meets and those that `pieces`
        raises. InputError too if a worker ends before its work.
    """
    workers: list[_Worker] = []
    busy: deque[tuple[float | None, int, Future[Encoded]]] = deque()
    failed: list[InputError | OSError] = []
    try:
        for number, piece in enumerate(_until_failure(pieces, failed)):
            if number < count:
                workers.append(worker := _Worker())
                worker.start(task)
            if number >= AHEAD * count:
                yield _done(*busy.popleft())
            answer = workers[number % count].ask(piece)
            busy.append((piece.share, piece.before + piece.rows, answer))
        while busy:
            yield _done(*busy.popleft())
        if failed:
            raise failed[0]
        for worker in workers:
            solver.join(worker.ask(None).result())
        solver.bad.sort()
    finally:
        for worker in workers:
            worker.end()


def serve() -> None:
    """Be a worker."""
    # What else is printed must not stand among the answers.
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    questions = sys.stdin.buffer
    try:
        task = pickle.load(questions)
        solver, answer = task.solver(), None
        while True:
            pickle.dump(answer, answers, protocol=5)
            answers.flush()
            answer = _answered(task, solver, pickle.load(questions))
    except (EOFError, BrokenPipeError):  # the process that asks is gone
        os._exit(0)


def _answered(task: Task, solver: Solver, piece: Piece | None) -> object:
    if piece is None:
        return solver.report()
    try:
        return task.done(piece, solver)
    except (InputError, ConvergenceError) as error:
        return error


def _until_failure(pieces: Iterator[Piece], failed: list[InputError | OSError]) -> Iterator[Piece]:
    """Pieces up to a failure, which is kept: rows before it may have failures of their own."""
    try:
        yield from pieces
    except (InputError, OSError) as error:
        failed.append(error)


def _done(share: float | None, rows: int, answer: Future[Encoded]) -> Done:
    return Done(share, rows, answer.result())


class _Worker:
    """The other end of `serve`: a thread that asks and waits."""

    def __init__(self) -> None:
        self._process = subprocess.Popen(
            [
                sys.executable,
                "-P",
                "-c",
                COMMAND,
            ],  # -P: the same path, and not the folder before it
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)},
            start_new_session=True,  # Ctrl-C reaches this process alone, which ends the worker
        )
        self._questions: SimpleQueue[tuple[Task | Piece | None, Future[Any]] | None] = SimpleQueue()
        # A daemon: Python does not wait for it, wherever Ctrl-C may come.
        self._thread = Thread(target=self._talk, daemon=True)

    def start(self, task: Task) -> None:
        self._questions.put((task, Future()))
        self._thread.start()

    def ask(self, question: Piece | None) -> Future[Any]:
        """The answer, when the questions before it have theirs."""
        answer: Future[Any] = Future()
        self._questions.put((question, answer))
        return answer

    def end(self) -> None:
        self._process.kill()
        self._questions.put(None)
        if self._thread.is_alive():
            self._thread.join()
        self._close()

    def _talk(self) -> None:
        while entry := self._questions.get():
            question, answer = entry
            try:
                answer.set_result(self._answer(question))
            except Exception as error:
                answer.set_exception(error)

    def _answer(self, question: Task | Piece | None) -> Any:
        try:
            self._send(question)
            assert self._process.stdout
            found = pickle.load(self._process.stdout)
        except (BrokenPipeError, EOFError, pickle.UnpicklingError, ValueError):  # or closed by then
            raise self._lost() from None
        if isinstance(found, Exception):
            raise found
        return found

    def _send(self, message: Task | Piece | None) -> None:
        assert self._process.stdin
        pickle.dump(message, self._process.stdin, protocol=5)
        self._process.stdin.flush()

    def _lost(self) -> InputError:
        """What to say of a process that has ended, by itself or by a signal."""
        self._close()
        status = self._process.returncode
        if status < 0:
            how = f"by signal {-status}: it may lack memory, which fewer workers need less of"
        else:
            how = f"with status {status}: standard error has its last words"
        return InputError(f"a worker was ended {how}")

    def _close(self) -> None:
        """Wait for the end of the process, which comes with that of its input."""
        if self._process.stdout and not self._process.stdout.closed:
            self._process.communicate()
