"""Options of Snakemake with which a run could look finished and not be."""

import contextlib
import io

WHY = {
    "keep_incomplete": "half-made files would count as whole",
    "touch": "old files would count as new",
    "no_hooks": "results/PASSED would outlive what it is about",
    "ignore_incomplete": "half-made files would count as whole",
    "allowed_rules": "old files would count as new",
    "nolock": "two runs would mix their files",
}


class OptionError(Exception):
    """An option is not allowed."""


def is_dry(arguments):
    """Whether a command line asks for a plan alone, which must change nothing.

    Parameters
    ----------
    arguments : sequence of str
        The program first.
    """
    return _parsed(arguments).dryrun


def refuse_untrustworthy(arguments):
    """Refuse options, abbreviated or from a profile too, that make a verdict untrue.

    Parameters
    ----------
    arguments : sequence of str
        As for `is_dry`.

    Raises
    ------
    OptionError
        Naming the option.
    """
    given, usual = _parsed(arguments), _parsed(arguments[:1])
    for name, why in WHY.items():
        if getattr(given, name):
            raise OptionError(f"--{name.replace('_', '-')}: not allowed here, {why}")
    if given.rerun_triggers != usual.rerun_triggers:
        raise OptionError("--rerun-triggers: not allowed here, old files would count as new")


def _parsed(arguments):
    """Options as Snakemake reads them; none if another program calls Snakemake."""
    own = list(arguments[1:]) if "snakemake" in arguments[0] else []
    from snakemake.cli import parse_args  # here: only the process that was started has it

    with contextlib.redirect_stderr(io.StringIO()):  # it has said which profile it uses
        return parse_args(own)[1]
