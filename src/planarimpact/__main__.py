"""The command line: planarimpact {rebound,scene,fit,export,models}."""

import argparse
import csv
import re
import sys
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NoReturn

import numpy as np
from numpy.typing import ArrayLike

from planarimpact import (
    __version__,
    bodies,
    collision,
    continuum,
    export,
    fit,
    models,
)
from planarimpact import scene as tables
from planarimpact.common import checks
from planarimpact.common.cautions import Caution
from planarimpact.common.results import Regime

ABOUT = """
What happens when a rough, elastic body strikes a surface at an angle?
Incidence is v1(0)/(mu v2(0)): tangential over normal speed, over friction. All velocities come in
mu v2(0), negative where the contact point has turned round.
"""
# Columns that are written and their units; columns of text have no unit.
UNITS = {
    "velocity": "mu v2(0)",
    "peak_friction": "mu F2max",
    "dissipation": "mu^2 m2 v2(0)^2",
    "regime": "",
    "reversals": "1",
}
# Numbers that the command line accepts; Python's float() accepts others too, such as 1_000.
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?", re.ASCII | re.IGNORECASE)
WHOLE = re.compile(r"[+-]?\d+", re.ASCII)
# What is no option, as those have two minus signs. The pattern of argparse lacks -1e-3 before 3.14.
NEGATIVE = re.compile("-[^-]")
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
        options = _parser().parse_args(arguments)
        options.command(options)
        sys.stdout.flush()
    except (checks.InputError, checks.ConvergenceError) as error:
        _tell(f"planarimpact: {error}")
        return 2
    except BrokenPipeError:  # the reader of the output has closed the pipe
        sys.stdout = None  # Python would try to write the rest
    except OSError as error:
        name = checks.in_ascii(str(error.filename or "output"))
        _tell(f"planarimpact: {name}: {error.strerror}")
        return 2
    except KeyboardInterrupt:
        _tell("planarimpact: interrupted")
        return 130
    return 0


def _tell(words: str) -> None:
    """Say something on standard error, which is no part of a table."""
    print(words, file=sys.stderr)


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
    model, settings = models.get(options.model), dict(options.setting)
    model.refuse_others(settings)
    groups = {name: getattr(options, name) for name in GROUPS}
    result = models.rebound(model, x, **groups, **settings)
    fields = {**result._asdict(), "regime": Regime.names(result.regime)}
    columns = {
        f"{name} [{unit}]" if unit else name: fields[name]
        for name, unit in UNITS.items()
        if fields[name] is not None
    }
    loss = "none" if options.restitution == 1 else model.loss
    caution = Caution.of(loss, options.friction or 0, options.restitution).text
    if caution:
        _tell(f"caution: {caution}")
    described = {"model": [model.name] * len(x), "loss": [loss] * len(x)}
    _print({"incidence [mu v2(0)]": x} | columns | described)


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
    """List the models, or compare those that fit a pair of materials."""
    given = {name: value for name, value in vars(options).items() if value is not None}
    del given["command"]
    if given:
        if not {"material", "friction"} <= given.keys():
            raise checks.InputError("--material, --friction: needed are both, or no option at all")
        moduli = {k: bodies.Material(*v) for k, v in given.items() if isinstance(v, tuple)}
        columns, notes = models.compare(**given | moduli)
        _tell("\n".join(notes))
        return _print({name: [*map(_short, cells)] for name, cells in columns.items()})
    rows = models.MODELS.values()
    _print(
        {
            "model": list(models.MODELS),
            "cost": [model.cost for model in rows],
            "settings": [" ".join(f"{k}={v}" for k, v in model.settings.items()) for model in rows],
            "restitution": ["{:g} to {:g}".format(*model.restitution) for model in rows],
            "loss": [model.loss for model in rows],
            "valid": [model.valid for model in rows],
            "source": [model.source for model in rows],
        }
    )


def _short(value: str | float) -> str:
    """A cell with three digits, if it is a number."""
    if isinstance(value, str):
        return value
    return np.format_float_positional(value, 3, fractional=False, trim="-")


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


def _material(text: str) -> str | tuple[float, ...]:
    """Name of a material, or Young's modulus and Poisson's ratio."""
    moduli = tuple(map(_decimal, text.split(","))) if "," in text else ()
    if len(moduli) not in (0, 2) or NUMBER.fullmatch(text):
        raise argparse.ArgumentTypeError(f"{text!a}: allowed are NAME, and E,NU such as 2e11,0.3")
    return moduli or text


class _Parser(argparse.ArgumentParser):
    """A parser whose refusals show what they refuse in ASCII, those of argparse itself too."""

    def error(self, message: str) -> NoReturn:
        super().error(checks.in_ascii(message))

    def option(self, name: str, meaning: str, **settings: Any) -> None:
        """Add an option that says what it means."""
        self.add_argument(name, help=meaning, **settings)

    def number(self, name: str, meaning: str, **settings: Any) -> None:
        """Add an option that takes a number."""
        self.option(name, meaning, type=_decimal, **settings)


def _parser() -> argparse.ArgumentParser:
    """Parser of the command line, with one parser for each command."""
    parser = _Parser(prog="planarimpact", description=ABOUT)
    parser.add_argument("--version", action="version", version=f"planarimpact {__version__}")
    commands = parser.add_subparsers(required=True, metavar="command")

    def command(
        name: str, run: Callable[[argparse.Namespace], None], what: str, about: str, **settings: Any
    ) -> _Parser:
        """The parser of a command."""
        description = f"{what[0].upper()}{what[1:]}. {about}"
        added = commands.add_parser(name, help=what, description=description, **settings)
        added._negative_number_matcher = NEGATIVE
        added.set_defaults(command=run)
        return added

    rebound = command("rebound", _rebound, "state at separation", ABOUT)
    impact = rebound.add_mutually_exclusive_group(required=True)
    impact.add_argument("--incidence", type=_decimal, nargs="+", metavar="X")
    degrees = "of incidence, degrees from the normal; needs --friction"
    impact.add_argument("--angle", type=_decimal, nargs="+", help=degrees)
    rebound.number("--friction", "mu, above 0, for --angle")
    named = "below e = 1 one with a loss in its name [%(default)s]"
    rebound.option("--model", named, choices=models.MODELS, default="lumped")
    for name, (default, meaning) in GROUPS.items():
        option = "--" + name.replace("_", "-")
        rebound.number(option, f"{meaning} [%(default)s]", default=default)
    setting: dict[str, Any] = {"type": _setting, "action": "append", "default": []}
    setting |= {"dest": "setting", "metavar": "NAME=NUMBER"}
    rebound.option("--set", "a setting of the model, see `models`", **setting)

    scene = command(
        "scene",
        _scene,
        "solve a table of impacts",
        "One impact a row, each by a formula, the table of spheres or, some milliseconds each, the "
        "continuum. --explain says how many impacts each of them solved.",
        epilog=tables.HELP,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    scene.option("input", "the table: a name that ends in .csv, .csv.gz or .parquet")
    scene.option(
        "output", "the same table with the state after each impact: names as for the input"
    )
    scene.number(
        "--tolerance",
        "largest error: of the tangential velocity as a share of friction times normal speed, "
        "of friction as a share of its limit [%(default)s, which the whole table of spheres meets]"
        "; the smallest that is reached is about 1e-8 at restitution 1 and 1e-5 below",
        default=collision.TOLERANCE,
    )
    needed = "what takes the energy; needed where the table has no column for it"
    scene.option("--loss", needed, choices=continuum.LOSSES)
    explained = "say which model solved how many impacts, and why"
    scene.option("--explain", explained, action="store_true")
    left_out = "leave bad rows out, and list them by number in OUTPUT.bad.csv"
    scene.option("--skip-bad", left_out, action="store_true")
    rows = "rows of CSV that are in the memory at one time [%(default)s]"
    scene.option("--chunk", rows, type=_number, default=tables.CHUNK, metavar="ROWS")

    fitted = command(
        "fit",
        _fit,
        "parameters of time-stepped codes that come nearest to the continuum",
        "For LAMMPS, MercuryDPM and Yade: tangential stiffness and damping of a law, with which "
        "contacts of two equal solid spheres come nearest to the continuum, as lines of its input, "
        "the errors before and after, and what the overlap at this speed adds to them. They hold "
        "for one restitution, one material and a range of incidence.",
    )
    fitted.option("--law", "the code and its law", required=True, choices=fit.CODES)
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
        fitted.number(f"--{name}", meaning, required=True)
    fitted.option("--loss", "what takes the energy; needed below e = 1", choices=continuum.LOSSES)
    fitted.number(
        "--incidence-max",
        "end of the range of v1(0)/(mu v2(0)) that is fitted [where all slide throughout]",
    )

    exported = command(
        "export",
        _export,
        "write collisions of spheres as code in C or JavaScript",
        "The code needs nothing else. It collides any two spheres, vectors in and vectors out; the "
        "head of the file explains it.",
    )
    exported.option("output", "NAME.h, NAME.mjs or NAME.js", metavar="FILE")
    languages = "c, a header of C99 with NAME_collide, or js, a module of JavaScript with collide"
    choice: dict[str, Any] = {"choices": export.LANGUAGES, "dest": "language"}
    exported.option("--as", languages, required=True, **choice)
    errors = f"largest error, {' or '.join(f'{error:g}' for error in export.TABLES)} [%(default)s]"
    exported.number("--tolerance", errors, default=min(export.TABLES))

    compared = command(
        "models",
        _models,
        "list the models, or compare them for a pair of materials",
        "Without options: what each describes, and what it neglects. With --material and "
        "--friction: how far each is from the continuum, and how long it takes.",
    )
    # Their table is not read for the help of every command: that takes longer than the parser.
    names = "a name such as nylon or steel, of which a wrong one lists all, or E,NU: Young's "
    names += "modulus [Pa] and Poisson's ratio"
    material: dict[str, Any] = {"type": _material, "metavar": "NAME"}
    compared.option("--material", f"of the sphere: {names}", **material)
    compared.option("--on", "of what it strikes, likewise [a rigid body]", **material)
    compared.number("--friction", "mu, above 0")
    degrees = "of incidence, from and to, degrees from the normal [0 80]"
    compared.number("--angle", degrees, nargs=2)
    compared.number("--restitution", "e [as the softer material has it]")
    compared.option("--loss", "[as the softer material]", choices=continuum.LOSSES)
    return parser


if __name__ == "__main__":
    sys.exit(main())
