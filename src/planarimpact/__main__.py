"""The command line: planarimpact {rebound,history,compile,fit,scene,models}."""

import argparse
import csv
import io
import json
import math
import os
import re
import sys
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, TextIO

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
    response,
)
from planarimpact.ground import checks, files
from planarimpact.ground.arrays import ArrayLike
from planarimpact.ground.results import ContinuumHistory, History, Rebound, Regime

ABOUT = """
What happens when a rough, elastic body strikes a surface at an angle?
Incidence is v1(0)/(mu v2(0)): tangential over normal speed, over friction. All velocities come in
mu v2(0), negative where the contact point has turned round.
"""
# Columns that are written and their units, by type of result; columns of text have no unit.
UNITS: dict[type, dict[str, str]] = {
    Rebound: {
        "incidence": "mu v2(0)",
        "velocity": "mu v2(0)",
        "peak_friction": "mu F2max",
        "dissipation": "mu^2 m2 v2(0)^2",
        "regime": "",
        "reversals": "1",
    },
    History: {
        "time": "t_c",
        "normal": "m2 Omega v2(0)",
        "friction": "mu m2 Omega v2(0)",
        "velocity": "mu v2(0)",
        "spring": "mu v2(0)/Omega",
    },
    ContinuumHistory: {
        "time": "t_c",
        "normal": "F2max",
        "friction": "mu F2max",
        "velocity": "mu v2(0)",
        "contact_radius": "a_max",
        "stick_radius": "a_max",
    },
}
# Numbers that the command line accepts; Python's float() accepts others too, such as 1_000.
NUMBER = re.compile(
    r"[+-]?((?P<digits>\d+\.?\d*|\.\d+)(e[+-]?\d+)?|inf|infinity|nan)", re.ASCII | re.IGNORECASE
)
# Width of the line of progress.
COLUMNS_OF_PROGRESS = 60
# Number of incidences at which `models` measures errors.
INCIDENCES = 65
# Mass ratio m2/m1 of solid spheres.
SOLID_SPHERE = 3.5
# Name of the table of spheres in `compile`.
SPHERES = "spheres"
WHOLE = re.compile(r"[+-]?\d+", re.ASCII)
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
    if sys.stdout is None:  # the next file that is opened might get its descriptor
        print("planarimpact: standard output is closed", file=sys.stderr)
        return 2
    arguments = sys.argv[1:] if arguments is None else arguments
    options = _parser().parse_args([_spaced(argument) for argument in arguments])
    try:
        options.command(options)
        sys.stdout.flush()
    except (checks.InputError, checks.ConvergenceError) as error:
        print(f"planarimpact: {error}", file=sys.stderr)
        return 2
    except BrokenPipeError:  # the reader of the output has closed the pipe
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except OSError as error:
        print(f"planarimpact: {error.filename or 'output'}: {error.strerror}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("planarimpact: interrupted", file=sys.stderr)
        return 130
    return 0


def _spaced(argument: str) -> str:
    """A negative number with a space in front: else argparse takes -1e-3 or -inf for an option."""
    try:
        float(argument)
    except ValueError:
        return argument
    return f" {argument}" if argument.startswith("-") else argument


def _table(options: argparse.Namespace) -> None:
    """Write the columns of a command: to the terminal, or to a file whole or not at all."""
    as_json = _is_json(options)
    if options.output is None:
        sys.stdout.write(_text(options.columns(options), as_json))
        return
    with files.written(options.output) as partial:
        partial.write_text(_text(options.columns(options), as_json), encoding="utf-8")


def _is_json(options: argparse.Namespace) -> bool:
    """Whether a table is wanted in JSON, by the name of its file or by --format; else in CSV."""
    if options.output is None:
        return bool(options.format == "json")
    ending = Path(options.output).suffix.lower()
    if ending not in (".csv", ".json"):
        raise checks.InputError(
            f"--output {options.output}: allowed are names that end in .csv or .json"
        )
    if options.format and ending != f".{options.format}":
        raise checks.InputError(
            f"--format {options.format}: --output {options.output} ends in {ending}"
        )
    return ending == ".json"


def _rebound(options: argparse.Namespace) -> dict[str, ArrayLike]:
    """Columns of `rebound`."""
    x = options.incidence
    if options.angle is None:
        _refuse_ignored(options, ["friction"], "an incidence includes it")
    elif options.friction is None:
        raise checks.InputError("--angle: it needs --friction, from which the incidence follows")
    else:
        try:
            x = bodies.incidence_from_angle(options.angle, options.friction)
        except checks.InputError as error:
            raise checks.InputError(str(error).replace("theta_deg", "--angle")) from None
    if options.response is not None:
        _refuse_ignored(options, ["model", "loss", "setting", *GROUPS], "a response has its own")
        _refuse_replacing(options)
        compiled = response.load(options.response)
        model, e, result = compiled.model, compiled.parameters["restitution"], compiled(x)
    else:
        model, e, settings = _model(options), _restitution(options), _settings(options)
        result = models.rebound(model, x, **_chosen(options, GROUPS), **settings)
    named = result._replace(regime=Regime.names(result.regime))
    columns = _with_units(Rebound, {"incidence": x, **named._asdict()})
    return columns | _said(model, e, len(x))


def _said(model: str, restitution: float, rows: int) -> dict[str, ArrayLike]:
    """Columns of the model and what takes the energy."""
    return {"model": [model] * rows, "loss": [models.loss_of(model, restitution)] * rows}


def _restitution(options: argparse.Namespace) -> float:
    """The restitution, or its default."""
    return float(_groups(options)["restitution"])


def _groups(options: argparse.Namespace) -> dict[str, float]:
    """The groups, or their defaults, after a check."""
    groups = {name: value for name, (value, _) in GROUPS.items()} | _chosen(options, GROUPS)
    checks.impact(0.0, *groups.values())
    return groups


def _refuse_replacing(options: argparse.Namespace) -> None:
    """Refuse a response without a name, and a table that would overwrite it."""
    if not options.response:
        raise checks.InputError("--response '': allowed are names of files that `compile` writes")
    source, target = Path(options.response), Path(options.output or os.devnull)
    if source.exists() and target.exists() and source.samefile(target):
        raise checks.InputError(
            f"--output {target}: this is the file of --response; the table needs another name"
        )


def _history(options: argparse.Namespace) -> dict[str, ArrayLike]:
    """Columns of `history`."""
    chosen = _chosen(options, [*GROUPS, "samples", "tolerance"])
    result: History | ContinuumHistory
    name = _model(options)
    family, _, loss = name.partition(".")
    if family == "continuum":
        _refuse_ignored(options, ["samples"], "the continuum has a tolerance instead")
        result = continuum.history(options.incidence, **chosen, loss=loss or None)
    else:
        _refuse_ignored(options, ["tolerance"], "the lumped model is solved to rounding")
        result = lumped.history(options.incidence, **chosen, loss=loss or "hysteretic")
        if not loss:  # other numbers are told before
            checks.lossless(_restitution(options), lumped.LOSSES)
    columns = _with_units(type(result), result._asdict())
    return columns | _said(name, _restitution(options), len(result.time))


def _with_units(result_type: type, fields: Mapping[str, Any]) -> dict[str, ArrayLike]:
    """Columns by name and unit, from the fields of a result that have a value."""
    return {
        f"{name} [{unit}]" if unit else name: fields[name]
        for name, unit in UNITS[result_type].items()
        if fields[name] is not None
    }


def _compile(options: argparse.Namespace) -> None:
    """Write a response, or the table of spheres."""
    if options.model == SPHERES:
        _compile_spheres(options)
        return
    settings = _settings(options)
    if "tolerance" in settings:
        raise checks.InputError("--set tolerance: a response has one tolerance, --tolerance")
    as_json = options.language == "json"
    if not as_json:
        export.checked_name(options.output, options.language)
    elif Path(options.output).suffix.lower() != ".json":
        raise checks.InputError(
            f"{options.output}: allowed are names that end in .json; with --as c or --as js others"
        )
    model = _model(options)
    arguments = _chosen(options, ["incidence_max", "tolerance", *GROUPS]) | settings
    progress = _show if sys.stderr.isatty() else None
    with files.written(options.output) as partial:  # it refuses a name before any computation
        compiled = response.compile(model, **arguments, progress=progress)
        if as_json:
            compiled.save(partial)
        else:
            code = export.text(compiled, options.output, options.language)
            partial.write_text(code, encoding="utf-8")
    loss = models.loss_of(model, _restitution(options))
    print(f"{options.output}: {compiled}{loss and f'; loss {loss}'}")


def _show(impacts: int, share: float) -> None:
    """Say on the terminal how far a response is, in place; the next line of output replaces it."""
    line = f"{impacts:,} impacts solved, {100 * share:.0f} % of the incidences fitted"
    print(f"\r{line:<{COLUMNS_OF_PROGRESS}}\r", end="", file=sys.stderr, flush=True)


def _compile_spheres(options: argparse.Namespace) -> None:
    """Write the table of spheres as code."""
    _refuse_ignored(
        options,
        ["incidence_max", "loss", "setting", *GROUPS],
        "the table of spheres takes every impact with its own",
    )
    if options.language == "json":
        raise checks.InputError(
            f"--as json: allowed with model {SPHERES} are {', '.join(export.LANGUAGES)}; "
            "Python has planarimpact.spheres"
        )
    tolerance = min(export.TABLES) if options.tolerance is None else options.tolerance
    export.write_spheres(options.output, options.language, tolerance)
    print(f"{options.output}: the table of spheres, within {tolerance:g}")


def _fit(options: argparse.Namespace) -> None:
    """Print the input of a time-stepped code."""
    material = bodies.Material(options.young_modulus, options.poisson_ratio)
    sphere = {name: getattr(options, name) for name in ("radius", "density", "friction", "speed")}
    # Before the fit, which takes its time.
    checks.positive("friction", options.friction)
    fit.overlap(material, options.radius, options.density, options.speed)
    groups = SOLID_SPHERE, float(bodies.stiffness_ratio(material)), options.restitution
    chosen = _chosen(options, ["loss", "incidence_max"])
    sys.stdout.write(fit.lines(fit.fit(options.law, *groups, **chosen), material, **sphere))


def _add_fit(commands: Any) -> None:
    """Add the parser of `fit`."""
    parser = commands.add_parser(
        "fit",
        help="parameters of LAMMPS, MercuryDPM or Yade that come nearest to the continuum",
        description="Tangential stiffness and damping of a law of a time-stepped code, with which "
        "contacts of two equal solid spheres come nearest to the continuum, as lines of its input, "
        "the errors before and after, and what the overlap at this speed adds to them. They hold "
        "for one restitution, one material and a range of incidence.",
    )
    parser.add_argument("--law", required=True, choices=fit.CODES, help="the code and its law")
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
        parser.add_argument(f"--{name}", type=decimal, required=True, help=meaning)
    losses = {"choices": continuum.LOSSES, "help": "what takes the energy; needed below e = 1"}
    parser.add_argument("--loss", **losses)
    parser.add_argument(
        "--incidence-max",
        type=decimal,
        help="end of the range of v1(0)/(mu v2(0)) that is fitted [where all slide throughout]",
    )
    parser.set_defaults(command=_fit)


def _scene(options: argparse.Namespace) -> None:
    """Solve a table, and say what became of its rows."""
    try:
        from planarimpact.scene import files as tables
    except ImportError as error:
        raise checks.InputError(str(error)) from None
    solver = tables.solve(
        options.input,
        options.output,
        options.tolerance,
        options.skip_bad,
        options.loss,
        notice=lambda words: _say(words, sys.stderr),
    )
    # Nothing else may stand in a table on standard output.
    stream = options.output == tables.STREAM
    words = sys.stderr if stream else sys.stdout
    _say(f"{options.output}: {solver.rows - len(solver.bad)} impacts", words)
    if stream:
        for row, problem in solver.bad:
            _say(f"row {row}, left out: {problem}", sys.stderr)
    elif solver.bad:
        _say(f"{options.output}.bad.csv: {len(solver.bad)} bad rows left out", words)
    if options.explain:
        _say(solver.explain(), words)


class _SceneHelp(argparse.Action):
    """Print the help of `scene`, with the columns that a table may have."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        try:
            from planarimpact.scene.columns import HELP
        except ImportError as error:
            parser.error(str(error))
        parser.epilog = HELP
        parser.print_help()
        parser.exit()


def _say(words: str, file: TextIO | None) -> None:
    """Print words, with escapes for letters that the file, if there is one, has none for."""
    encoding = getattr(file, "encoding", None) or "utf-8"
    print(words.encode(encoding, "backslashreplace").decode(encoding), file=file)


def _models(options: argparse.Namespace) -> dict[str, ArrayLike]:
    """Columns of `models`."""
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
    if options.restitution is not None:
        return columns | _errors(options)
    _refuse_ignored(options, ["loss", "mass_ratio", "stiffness_ratio"], "without --restitution")
    return columns


def _errors(options: argparse.Namespace) -> dict[str, ArrayLike]:
    """Errors of every model against the continuum, and where a measurement can show them."""
    groups = _groups(options)
    reference = models.reference(groups["restitution"], options.loss)
    loss = options.loss or continuum.LOSSES[0]
    limit = continuum.slip_throughout_limit(*groups.values(), loss=loss)
    x = np.linspace(0.0, float(limit), INCIDENCES)
    # A tenth of the default tolerance, so that the continuum itself has an error, too.
    tolerance = models.get(reference).settings["tolerance"] / 10
    exact = models.rebound(reference, x, **groups, tolerance=tolerance).velocity
    spread = models.input_spread(f"continuum.{loss}", x, **groups, tolerance=1e-3)
    columns: dict[str, list[float]] = {
        "rms [mu v2(0)]": [],
        "max [mu v2(0)]": [],
        "seen [1]": [],
    }
    for model in models.MODELS.values():
        error = np.full(x.size, np.nan)
        if models.admits(model, **groups):
            error = np.abs(model.rebound(x, **groups).velocity - exact)
        seen = np.mean(error > spread) if np.isfinite(error).all() else np.nan
        numbers = np.sqrt(np.mean(error**2)), np.max(error), seen
        for column, value in zip(columns.values(), numbers, strict=True):
            column.append(float(f"{value:.2g}"))
    used = ", ".join(f"{name} {value:g}" for name, value in groups.items())
    print(f"Errors against {reference} for {used}", file=sys.stderr)
    return dict(columns)


def _model(options: argparse.Namespace) -> str:
    """Name of the model, with the option --loss."""
    name = options.model or "lumped"
    _groups(options)
    if options.loss is None:
        return str(name)
    losses = models.losses(name)
    if options.loss not in losses:
        other = "continuum" if name == "lumped" else "lumped"
        has = f"{', '.join(losses)}; --model {other} has {', '.join(models.losses(other))}"
        why = f"allowed are {has}" if losses else "leave it out"
        raise checks.InputError(f"--loss {options.loss}: with model {name} {why}")
    return losses[options.loss]


def _chosen(options: argparse.Namespace, names: Iterable[str]) -> dict[str, Any]:
    """Options of these names that have a value; for the others the called function has defaults."""
    values = {name: getattr(options, name) for name in names}
    return {name: value for name, value in values.items() if value not in (None, [])}


def _refuse_ignored(options: argparse.Namespace, names: list[str], why: str) -> None:
    """Refuse options that have a value but would have no effect."""
    for name in _chosen(options, names):
        option = "--set" if name == "setting" else "--" + name.replace("_", "-")
        raise checks.InputError(f"{option}: it does not apply, {why}")


def _settings(options: argparse.Namespace) -> dict[str, float]:
    """Settings of the model, from the options --set NAME=NUMBER."""
    settings = {}
    for text in options.setting:
        name, equals, value = text.partition("=")
        if not equals:
            raise checks.InputError(f"--set {text}: allowed is NAME=NUMBER, such as steps=256")
        if name in settings:
            raise checks.InputError(f"--set {text}: {name} is set twice, allowed is once")
        try:
            settings[name] = number(value)
        except argparse.ArgumentTypeError as error:
            raise checks.InputError(f"--set {name}: {error}") from None
    models.refuse_unknown(models.get(_model(options)), settings)
    return settings


def decimal(text: str) -> float:
    """Number of a text in decimal notation; argparse adds the option's name to a refusal.

    Examples
    --------
    >>> decimal("64"), decimal("-1e3")
    (64.0, -1000.0)
    """
    text = text.strip(" ")
    match = NUMBER.fullmatch(text)
    if not match:
        raise argparse.ArgumentTypeError(
            f"{text!r}: allowed are decimal numbers, such as 0.5 or -1e-3"
        )
    value = float(text)
    if value == 0 and re.search("[1-9]", match["digits"]):
        raise argparse.ArgumentTypeError(
            f"{text!r}: it is too small for a number; allowed are 0 and numbers from 5e-324"
        )
    return value


def number(text: str) -> float:
    """Number of a text as `decimal` reads it, an integer where it is written as one.

    Examples
    --------
    >>> number("64"), number("-1e3")
    (64, -1000.0)
    """
    value = decimal(text)
    return int(text) if WHOLE.fullmatch(text.strip(" ")) and math.isfinite(value) else value


def _text(columns: Mapping[str, ArrayLike], as_json: bool) -> str:
    """Columns of equal length as JSON or CSV."""
    plain = {name: np.asarray(values).tolist() for name, values in columns.items()}
    if as_json:
        named = {name: [files.or_null(x) for x in xs] for name, xs in plain.items()}
        return json.dumps(named, indent=1) + "\n"
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(plain)
    writer.writerows(zip(*plain.values(), strict=True))
    return buffer.getvalue()


class _Once(argparse.Action):
    """Store the value of an option, and refuse a second one."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        stored = vars(namespace).setdefault("stored", set())
        if self.dest in stored:
            raise argparse.ArgumentError(self, f"{values!r} is a second value, allowed is one")
        stored.add(self.dest)
        setattr(namespace, self.dest, values)


class _Parser(argparse.ArgumentParser):
    """A parser that accepts each option once; the parsers of its commands do so too."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        self.register("action", None, _Once)


def _parser() -> argparse.ArgumentParser:
    """Parser of the command line, with one parser for each command."""
    called = Path(sys.argv[0])
    programs = {"planarimpact": "planarimpact", "__main__": "python -m planarimpact"}
    program = programs.get(
        called.stem, f"python {called.name}"
    )  # a file with a model of a user's own
    parser = _Parser(prog=program, description=ABOUT)
    parser.add_argument("--version", action="version", version=f"planarimpact {__version__}")
    commands = parser.add_subparsers(required=True, metavar="command")

    rebound = commands.add_parser(
        "rebound", help="state at separation", description="State at separation." + ABOUT
    )
    impact = rebound.add_mutually_exclusive_group(required=True)
    impact.add_argument("--incidence", type=decimal, nargs="+", metavar="X")
    impact.add_argument(
        "--angle",
        type=decimal,
        nargs="+",
        help="of incidence, degrees from the normal; needs --friction",
    )
    rebound.add_argument("--friction", type=decimal, help="mu, above 0, for --angle")
    rebound.add_argument("--response", metavar="FILE", help="use what `compile` has written")
    _add_model(rebound, list(models.MODELS))
    _add_output(rebound)
    rebound.set_defaults(command=_table, columns=_rebound)

    history = commands.add_parser(
        "history",
        help="forces and velocity over one contact",
        description="Forces and velocity over one contact, against time in that of compression."
        + ABOUT,
    )
    history.add_argument("--incidence", type=decimal, required=True, metavar="X")
    history.add_argument("--samples", type=number, help="of lumped [400]")
    history.add_argument("--tolerance", type=decimal, help="of continuum [1e-4]")
    names = [name for name in models.MODELS if name.startswith(("lumped", "continuum"))]
    _add_model(history, names, settings=False)
    _add_output(history)
    history.set_defaults(command=_table, columns=_history)

    compiled = commands.add_parser(
        "compile",
        help="make a fast response of one pair of bodies",
        description="Make a response, a table of polynomials that gives the rebound of one pair of "
        "bodies in nanoseconds, and write it to a file. With --model spheres the table of spheres "
        "is written as code: it collides any two spheres, vectors in and vectors out." + ABOUT,
    )
    compiled.add_argument("output", metavar="FILE", help="NAME.json, NAME.h, NAME.mjs or NAME.js")
    compiled.add_argument(
        "--as",
        choices=["json", *export.LANGUAGES],
        default="json",
        dest="language",
        help="json, which `rebound` reads; c, a header of C99 with NAME_velocity(x) and "
        "NAME_rebound(x); or js, a module of JavaScript with velocity(x) and rebound(x) "
        "[%(default)s]",
    )
    errors = " or ".join(f"{error:g}" for error in export.TABLES)
    defaults = ", ".join(f"{kind} {error:g}" for kind, error in response.TOLERANCES.items())
    compiled.add_argument(
        "--tolerance",
        type=decimal,
        help=f"largest error [by the model's cost, see `models`: {defaults}]; with --model "
        f"{SPHERES} {errors} [{min(export.TABLES):g}]",
    )
    compiled.add_argument(
        "--incidence-max", type=decimal, help=f"largest |incidence| [{response.INCIDENCE_MAX:g}]"
    )
    _add_model(compiled, [*models.MODELS, SPHERES])
    compiled.set_defaults(command=_compile)

    _add_fit(commands)

    scene = commands.add_parser(
        "scene",
        help="solve a table of impacts",
        description="Solve a table of impacts, one a row, each by a formula, the table of spheres "
        "or the continuum.\nWhere the continuum takes long, standard error says for how many.",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        add_help=False,
    )
    scene.add_argument("-h", "--help", action=_SceneHelp, nargs=0, help="show this help")
    scene.add_argument(
        "input",
        help="the table: a name that ends in .csv, .csv.gz or .parquet, or - for standard input, "
        "which is CSV",
    )
    scene.add_argument(
        "output",
        help="the same table with the state after each impact: names as for the input, or - for "
        "standard output",
    )
    scene.add_argument(
        "--tolerance",
        type=decimal,
        default=collision.TOLERANCE,
        help="largest error: of the tangential velocity as a share of friction times normal speed, "
        "of friction as a share of its limit [%(default)s, which the whole table of spheres meets]"
        "; the smallest that is reached is about 1e-8 at restitution 1 and 1e-5 below",
    )
    scene.add_argument(
        "--loss",
        choices=continuum.LOSSES,
        help="what takes the energy below e = 1; needed where the table has no column for it",
    )
    scene.add_argument(
        "--explain", action="store_true", help="say which model solved how many impacts, and why"
    )
    scene.add_argument(
        "--skip-bad",
        action="store_true",
        help="leave bad rows out, and list them by number in OUTPUT.bad.csv, or on standard error "
        "where OUTPUT is -",
    )
    scene.set_defaults(command=_scene)

    listing = commands.add_parser(
        "models",
        help="list the models",
        description="The models. With --restitution each has its error in velocity, root mean "
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
    _add_output(listing)
    listing.set_defaults(command=_table, columns=_models)
    return parser


def _add_model(parser: argparse.ArgumentParser, names: list[str], settings: bool = True) -> None:
    """Add the options of a model, its loss, its groups and, if wanted, its settings."""
    parser.add_argument("--model", choices=names, help="[lumped]")
    parser.add_argument(
        "--loss",
        choices=sorted({*lumped.LOSSES, *continuum.LOSSES}),
        help="what takes the energy; below e = 1 lumped and continuum need it. For lumped "
        "hysteretic (the paper's), unloading-stiffness or viscous; for continuum viscous or "
        "plastic",
    )
    _add_groups(parser)
    if settings:
        parser.add_argument(
            "--set",
            action="append",
            default=[],
            dest="setting",
            metavar="NAME=NUMBER",
            help="a setting of the model, see `models`",
        )


def _add_groups(parser: argparse.ArgumentParser) -> None:
    """Add the options of the groups."""
    for name, (default, meaning) in GROUPS.items():
        option = "--" + name.replace("_", "-")
        parser.add_argument(option, type=decimal, help=f"{meaning} [{default}]")


def _add_output(parser: argparse.ArgumentParser) -> None:
    """Add the options of a table that is written."""
    parser.add_argument("--format", choices=["csv", "json"], help="on the terminal [csv]")
    parser.add_argument(
        "--output", metavar="FILE", help="instead of the terminal: NAME.csv or NAME.json"
    )


if __name__ == "__main__":
    sys.exit(main())
