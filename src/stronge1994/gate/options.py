"""Options of Snakemake that are refused: with them a run could look finished without being so."""

import contextlib
import io
from collections.abc import Sequence
from typing import Any

WHY = {
    "keep_incomplete": "half-made files would count as whole",
    "touch": "old files would count as new",
    "no_hooks": "results/PASSED would outlive what it is about",
    "ignore_incomplete": "half-made files would count as whole",
    "allowed_rules": "old files would count as new",
    "consider_ancient": "old files would count as new",
    "nolock": "two runs would mix their files",
    "drop_metadata": "a change of the config would go unnoticed",
}


class OptionError(Exception):
    """An option is not allowed."""


def is_dry(arguments: Sequence[str]) -> bool:
    """Whether a command line asks only for the plan of a run, which must change nothing.

    Parameters
    ----------
    arguments : sequence of str
        The program first.
    """
    return _parsed(arguments).dryrun


def refuse_untrustworthy(arguments: Sequence[str]) -> None:
    """Refuse options that make a verdict untrue, also abbreviated ones and those of a profile.

    Parameters
    ----------
    arguments : sequence of str
        As for `is_dry`.

    Raises
    ------
    OptionError
        Naming the option.
    """
    from snakemake.settings.types import RerunTrigger

    given = _parsed(arguments)
    for name, why in WHY.items():
        if getattr(given, name):
            raise OptionError(f"--{name.replace('_', '-')}: not allowed here, {why}")
    if not set(RerunTrigger) <= set(given.rerun_triggers):
        raise OptionError("--rerun-triggers: not allowed here, old files would count as new")


def _parsed(arguments: Sequence[str]) -> Any:
    """Options as Snakemake reads them, its profiles too."""
    # Imported here: only the process that was started has this module.
    from snakemake.cli import parse_args

    try:
        with contextlib.redirect_stderr(io.StringIO()):  # it has said which profile it uses
            return parse_args(list(arguments[1:]))[1]
    except SystemExit:
        raise OptionError(
            "start Snakemake by its own command line, whose options are checked"
        ) from None
