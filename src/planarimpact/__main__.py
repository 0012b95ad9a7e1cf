"""The command line: planarimpact {rebound,history,scene,fit,export,models}."""

import argparse
import csv
import io
import os
import re
import sys
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NoReturn

import numpy as np

from planarimpact import (
    __version__,
    bodies,
    collision,
    continuum,
    export,
    fit,
    lumped,
    models,
)
from planarimpact import scene as tables
from planarimpact.common import checks, losses
from planarimpact.common.arrays import ArrayLike
from planarimpact.common.results import History, Rebound, Regime
from planarimpact.continuum import ContinuumHistory

ABOUT = """
What happens when a rough, elastic body strikes a surface at an angle?
Incidence is v1(0)/(mu v2(0)): tangential over normal speed, over friction. All velocities come in
mu v2(0), negative where the contact point has turned round.
"""
# Columns that are written and their units, by type of result; columns of text have no unit.
UNITS: dict[type, dict[str, str]] = {
    Rebound: {
        "velocity": "mu v2(0)",
        "peak_friction": "mu F2max",
        "dissipation": "mu^2 m2 v2(0)^2",
        "regime": "",
        "reversals": "1",
    },
    History: {
        "time": "t_c",
        "normal": "m2 Omega v2(0)",
        "friction_force": "mu m2 Omega v2(0)",
        "velocity": "mu v2(0)",
        "spring": "mu v2(0)/Omega",
    },
    ContinuumHistory: {
        "time": "t_c",
        "normal": "F2max",
        "friction_force": "mu F2max",
        "velocity": "mu v2(0)",
        "contact_radius": "a_max",
        "stick_radius": "a_max",
    },
}
# Columns whose names are not those of their fields, as programs read them.
COLUMNS = {"friction_force": "friction"}
# Numbers that the command line accepts; Python's float() accepts others too, such as 1_000.
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?", re.ASCII | re.IGNORECASE)
WHOLE = re.compile(r"[+-]?\d+", re.ASCII)
# What is no option, as those have two minus signs. The pattern of argparse lacks -1e-3 before 3.14.
NEGATIVE = re.compile("-[^-]")
# Number of incidences at which `models` measures errors.
INCIDENCES = 65
# Mass ratio m2/m1 of solid spheres.
SOLID_SPHERE = 3.5
# Defaults and meanings of the groups.
GROUPS = {
    "mass_ratio": (3.5, "m2/m1: 3.5 for a solid sphere, 2.5 for a thin shell, 3 for a disc"),
    "stiffness_ratio": (1.21, "zeta^2, normal over tangential stiffness: (2-nu)/(2(1-nu))"),
    "restitution": (1.0, "energetic coefficient e, 0 to 1"),
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command and return the exit status: 0, or 2 after a refusal, which prints one line.

    Examples
    --------
    >>> main(["rebound", "--incidence", "8", "--model", "rigid"])
    incidence [mu v2(0)],velocity [mu v2(0)],peak_friction [mu F2max],\
dissipation [mu^2 m2 v2(0)^2],regime,model,loss
    8.0,1.0,1.0,9.0,SLIP_THROUGHOUT,rigid,none
    0
    """
    try:
        _prepare_streams()
        options = _parser().parse_args(arguments)
        options.command(options)
        sys.stdout.flush()
    except (checks.InputError, checks.ConvergenceError) as error:
        _tell(f"planarimpact: {error}")
        return 2
    except BrokenPipeError:  # the reader of the output has closed the pipe
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except OSError as error:
        name = checks.in_ascii(str(error.filename or "output"))
        _tell(f"planarimpact: {name}: {error.strerror}")
        return 2
    except KeyboardInterrupt:
        _tell("planarimpact: interrupted")
        return 130
    return 0


def _tell(words: str) -> None:
    """Say something on standard error; that nobody can read it is no error."""
    try:
        print(words, file=sys.stderr, flush=True)
    except OSError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stderr.fileno())


def _prepare_streams() -> None:
    """Refuse a closed standard output; letters that a terminal lacks are written as codes."""
    for name, mode in {"stdin": "r", "stdout": "w", "stderr": "w"}.items():
        if getattr(sys, name) is None:  # else the next file that is opened would take its place
            setattr(sys, name, open(os.devnull, mode))  # noqa: SIM115
            if name == "stdout":
                raise checks.InputError("standard output is closed")
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def _print(columns: Mapping[str, ArrayLike]) -> None:
    """Print columns of equal length as CSV."""
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(columns)
    plain = [np.asarray(values).tolist() for values in columns.values()]
    writer.writerows(zip(*plain, strict=True))


def _rebound(options: argparse.Namespace) -> None:
    x = options.incidence
    if (options.angle is None) != (options.friction is None):
        raise checks.InputError(
            "--angle, --friction: allowed are both, from which the incidence follows, or neither"
        )
    if options.angle is not None:
        x = bodies.incidence_from_angle(options.angle, options.friction)
    settings = dict(options.setting)
    if len(settings) < len(options.setting):
        raise checks.InputError("--set: a setting is given twice, allowed is once")
    models.refuse_unknown(models.get(options.model), settings)
    result = models.rebound(options.model, x, **_groups(options), **settings)
    columns = _with_units(result._replace(regime=Regime.names(result.regime)))
    _print({"incidence [mu v2(0)]": x} | columns | _model_and_loss(options, len(x)))


def _history(options: argparse.Namespace) -> None:
    x, groups, (family, _, loss) = options.incidence, _groups(options), options.model.partition(".")
    checks.impact(x, *groups.values())
    models.rebound(options.model, 0.0, **groups)  # refuses what this model does not have
    result: History | ContinuumHistory
    if family == "continuum":
        _refuse_ignored(options, ["samples"], "the continuum has a tolerance instead")
        result = continuum.history(x, **groups, tolerance=options.tolerance, loss=loss or None)
    else:
        _refuse_ignored(options, ["tolerance"], "the lumped model is solved to rounding")
        loss = loss or lumped.LOSSES[0]  # at e = 1 all are the same
        result = lumped.history(x, **groups, samples=options.samples, loss=loss)
    _print(_with_units(result) | _model_and_loss(options, len(result.time)))


def _groups(options: argparse.Namespace) -> dict[str, float]:
    """The groups by name."""
    return {name: getattr(options, name) for name in GROUPS}


def _with_units(result: Rebound | History | ContinuumHistory) -> dict[str, ArrayLike]:
    """Columns by name and unit, from the fields of a result that have a value."""
    fields = result._asdict()
    return {
        f"{COLUMNS.get(name, name)} [{unit}]" if unit else name: fields[name]
        for name, unit in UNITS[type(result)].items()
        if fields[name] is not None
    }


def _model_and_loss(options: argparse.Namespace, rows: int) -> dict[str, ArrayLike]:
    """Columns of the model and of what takes the energy."""
    loss = "none" if options.restitution == 1 else models.get(options.model).loss
    return {"model": [options.model] * rows, "loss": [loss] * rows}


def _refuse_ignored(options: argparse.Namespace, names: list[str], why: str) -> None:
    """Refuse options that were given but would have no effect."""
    for name in names:
        if getattr(options, name) != options.parser.get_default(name):
            raise checks.InputError(f"--{name.replace('_', '-')}: it does not apply, {why}")


def _export(options: argparse.Namespace) -> None:
    export.write_spheres(options.output, options.language, options.tolerance)
    print(f"{options.output}: the table of spheres, within {options.tolerance:g}")


def _fit(options: argparse.Namespace) -> None:
    """Print the input of a time-stepped code."""
    material = bodies.Material(options.young_modulus, options.poisson_ratio)
    sphere = {name: getattr(options, name) for name in ("radius", "density", "friction", "speed")}
    # Before the fit, which takes its time.
    checks.positive("friction", options.friction)
    fit.overlap(material, options.radius, options.density, options.speed)
    groups = SOLID_SPHERE, float(bodies.stiffness_ratio(material)), options.restitution
    found = fit.fit(options.law, *groups, loss=options.loss, incidence_max=options.incidence_max)
    sys.stdout.write(fit.lines(found, material, **sphere))


def _scene(options: argparse.Namespace) -> None:
    """Solve a table, and say what became of its rows."""
    paths = options.input, options.output
    settings = options.tolerance, options.loss, options.skip_bad, options.chunk
    try:
        report = tables.solve_file(*paths, *settings)
    except ImportError as error:
        raise checks.InputError(str(error)) from None
    if report.own:
        _tell(f"not known, and carried over as they are: columns {', '.join(report.own)}")
    print(f"{options.output}: {report.rows - len(report.bad)} impacts")
    if report.bad:
        print(f"{options.output}.bad.csv: {len(report.bad)} bad rows left out")
    if options.explain:
        print(report.explain())


def _models(options: argparse.Namespace) -> None:
    rows = models.MODELS.values()
    columns: dict[str, ArrayLike] = {
        "model": list(models.MODELS),
        "cost": [model.cost for model in rows],
        "settings": [" ".join(f"{k}={v}" for k, v in model.settings.items()) for model in rows],
        "restitution": ["{:g} to {:g}".format(*model.restitution) for model in rows],
        "loss": [model.loss for model in rows],
        "valid": [model.valid for model in rows],
        "source": [model.source for model in rows],
    }
    if options.restitution is None:
        _refuse_ignored(options, ["loss", "mass_ratio", "stiffness_ratio"], "without --restitution")
        _print(columns)
    else:
        _print(columns | _errors(_groups(options), options.loss))


def _errors(groups: dict[str, float], loss: str | None) -> dict[str, ArrayLike]:
    """Errors of every model against the continuum, and where a measurement can show them."""
    checks.impact(0.0, *groups.values())
    reference = models.reference(groups["restitution"], loss)
    loss = loss or losses.VISCOUS.name  # at e = 1 both losses have the same continuum
    limit = continuum.slip_throughout_limit(**groups, loss=loss)
    x = np.linspace(0.0, float(limit), INCIDENCES)
    # A tenth of the default tolerance, so that the continuum itself has an error, too.
    tolerance = models.get(reference).settings["tolerance"] / 10
    exact = models.rebound(reference, x, **groups, tolerance=tolerance).velocity
    spread = models.input_spread(f"continuum.{loss}", x, **groups, tolerance=1e-3)
    rows: list[list[Any]] = []
    for model in models.MODELS.values():
        error = np.full(x.size, np.nan)
        if models.admits(model, **groups):
            error = np.abs(model.rebound(x, **groups).velocity - exact)
        seen = np.mean(error > spread) if np.isfinite(error).all() else np.nan
        rows.append([np.sqrt(np.mean(error**2)), np.max(error), seen])
    used = ", ".join(f"{name} {value:g}" for name, value in groups.items())
    _tell(f"Errors against {reference} for {used}")
    names = "rms [mu v2(0)]", "max [mu v2(0)]", "seen [1]"
    rounded = [[float(f"{value:.2g}") for value in row] for row in rows]
    return dict(zip(names, np.transpose(rounded), strict=True))


def _decimal(text: str) -> float:
    """Number of a text in decimal notation; argparse adds the option's name to a refusal."""
    if not NUMBER.fullmatch(text):
        raise argparse.ArgumentTypeError(
            f"{text!a}: allowed are decimal numbers, such as 0.5 or -1e-3"
        )
    return float(text)


def _number(text: str) -> float:
    """Number of a text as `_decimal` reads it, an integer where it is written as one."""
    return int(text) if WHOLE.fullmatch(text) else _decimal(text)


def _setting(text: str) -> tuple[str, float]:
    """Name and number of a setting, from NAME=NUMBER."""
    name, equals, value = text.partition("=")
    if not equals:
        raise argparse.ArgumentTypeError(f"{text}: allowed is NAME=NUMBER, such as steps=256")
    return name, _number(value)


class _Once(argparse.Action):
    """Store the value of an option, and refuse a second one."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        if getattr(namespace, self.dest) is not self.default:
            raise argparse.ArgumentError(self, f"{values!a} is a second value, allowed is one")
        setattr(namespace, self.dest, values)


class _Parser(argparse.ArgumentParser):
    """A parser whose refusals show what they refuse in ASCII, those of argparse itself too."""

    def error(self, message: str) -> NoReturn:
        super().error(checks.in_ascii(message))


def _parser() -> argparse.ArgumentParser:
    """Parser of the command line, with one parser for each command."""
    parser = _Parser(prog="planarimpact", description=ABOUT)
    parser.add_argument("--version", action="version", version=f"planarimpact {__version__}")
    commands = parser.add_subparsers(required=True, metavar="command")

    def command(
        name: str, run: Callable[[argparse.Namespace], None], what: str, about: str, **settings: Any
    ) -> argparse.ArgumentParser:
        """The parser of a command, which accepts each option once."""
        description = f"{what[0].upper()}{what[1:]}. {about}"
        added = commands.add_parser(name, help=what, description=description, **settings)
        added.register("action", None, _Once)
        added._negative_number_matcher = NEGATIVE
        added.set_defaults(command=run, parser=added)
        return added

    rebound = command("rebound", _rebound, "state at separation", ABOUT)
    impact = rebound.add_mutually_exclusive_group(required=True)
    impact.add_argument("--incidence", type=_decimal, nargs="+", metavar="X")
    impact.add_argument(
        "--angle",
        type=_decimal,
        nargs="+",
        help="of incidence, degrees from the normal; needs --friction",
    )
    rebound.add_argument("--friction", type=_decimal, help="mu, above 0, for --angle")
    _add_model(rebound, "")
    rebound.add_argument(
        "--set",
        type=_setting,
        action="append",
        default=[],
        dest="setting",
        metavar="NAME=NUMBER",
        help="a setting of the model, see `models`",
    )

    history = command("history", _history, "forces and velocity over one contact", ABOUT)
    history.add_argument("--incidence", type=_decimal, required=True, metavar="X")
    history.add_argument("--samples", type=_number, default=400, help="of lumped [%(default)s]")
    history.add_argument(
        "--tolerance", type=_decimal, default=1e-4, help="of continuum [%(default)s]"
    )
    _add_model(history, ("lumped", "continuum"))

    scene = command(
        "scene",
        _scene,
        "solve a table of impacts",
        "One impact a row, each by a formula, the table of spheres or, some milliseconds each, the "
        "continuum. --explain says how many impacts each of them solved.",
        epilog=tables.HELP,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    scene.add_argument(
        "input",
        help="the table: a name that ends in .csv, .csv.gz or .parquet",
    )
    scene.add_argument(
        "output",
        help="the same table with the state after each impact: names as for the input",
    )
    scene.add_argument(
        "--tolerance",
        type=_decimal,
        default=collision.TOLERANCE,
        help="largest error: of the tangential velocity as a share of friction times normal speed, "
        "of friction as a share of its limit [%(default)s, which the whole table of spheres meets]"
        "; the smallest that is reached is about 1e-8 at restitution 1 and 1e-5 below",
    )
    scene.add_argument(
        "--loss",
        choices=continuum.LOSSES,
        help="what takes the energy; needed where the table has no column for it",
    )
    scene.add_argument(
        "--explain", action="store_true", help="say which model solved how many impacts, and why"
    )
    scene.add_argument(
        "--skip-bad",
        action="store_true",
        help="leave bad rows out, and list them by number in OUTPUT.bad.csv",
    )
    scene.add_argument(
        "--chunk",
        type=_number,
        default=tables.CHUNK,
        metavar="ROWS",
        help="rows of CSV that are in the memory at one time [%(default)s]",
    )

    fitted = command(
        "fit",
        _fit,
        "parameters of time-stepped codes that come nearest to the continuum",
        "For LAMMPS, MercuryDPM and Yade: tangential stiffness and damping of a law, with which "
        "contacts of two equal solid spheres come nearest to the continuum, as lines of its input, "
        "the errors before and after, and what the overlap at this speed adds to them. They hold "
        "for one restitution, one material and a range of incidence.",
    )
    fitted.add_argument("--law", required=True, choices=fit.CODES, help="the code and its law")
    for name, meaning in {
        "restitution": f"energetic coefficient e, {fit.LEAST_RESTITUTION:g} to 1",
        "friction": "mu",
        "young-modulus": "[Pa]",
        "poisson-ratio": "up to 0.5",
        "radius": "[m]",
        "density": "[kg/m^3]",
        "speed": "normal speed of approach [m/s], for the length of a step and linear springs; up "
        "to that at which spheres overlap by a tenth of their radius",
    }.items():
        fitted.add_argument(f"--{name}", type=_decimal, required=True, help=meaning)
    fitted.add_argument(
        "--loss", choices=continuum.LOSSES, help="what takes the energy; needed below e = 1"
    )
    fitted.add_argument(
        "--incidence-max",
        type=_decimal,
        help="end of the range of v1(0)/(mu v2(0)) that is fitted [where all slide throughout]",
    )

    exported = command(
        "export",
        _export,
        "write collisions of spheres as code in C or JavaScript",
        "The code needs nothing else. It collides any two spheres, vectors in and vectors out; the "
        "head of the file explains it.",
    )
    exported.add_argument("output", metavar="FILE", help="NAME.h, NAME.mjs or NAME.js")
    exported.add_argument(
        "--as",
        choices=export.LANGUAGES,
        required=True,
        dest="language",
        help="c, a header of C99 with NAME_collide, or js, a module of JavaScript with collide",
    )
    errors = " or ".join(f"{error:g}" for error in export.TABLES)
    exported.add_argument(
        "--tolerance",
        type=_decimal,
        default=min(export.TABLES),
        help=f"largest error, {errors} [%(default)s]",
    )

    listing = command(
        "models",
        _models,
        "list the models",
        "With --restitution each has its error in velocity, root mean "
        "square and largest, against the continuum with the loss, over all incidences that stick "
        "at some time; nan where it does not take this restitution. The continuum itself has the "
        "error of its default tolerance. Errors of restitution of 0.02 and of friction of 10 % "
        "move the answer, too: seen is the share of incidences where the error of the model is "
        "larger than that; at restitution 1 it has the loss, or else the viscous one.",
    )
    listing.add_argument(
        "--loss", choices=continuum.LOSSES, help="what takes the energy; needed below e = 1"
    )
    _add_groups(listing)
    listing.set_defaults(restitution=None)
    return parser


def _add_model(parser: argparse.ArgumentParser, begin: str | tuple[str, ...]) -> None:
    """Add the options of a model, of those whose names begin so, and its groups."""
    parser.add_argument(
        "--model",
        choices=[name for name in models.MODELS if name.startswith(begin)],
        default="lumped",
        help="below e = 1 one with a loss in its name [%(default)s]",
    )
    _add_groups(parser)


def _add_groups(parser: argparse.ArgumentParser) -> None:
    """Add the options of the groups."""
    for name, (default, meaning) in GROUPS.items():
        option = "--" + name.replace("_", "-")
        parser.add_argument(option, type=_decimal, default=default, help=f"{meaning} [%(default)s]")


if __name__ == "__main__":
    sys.exit(main())
