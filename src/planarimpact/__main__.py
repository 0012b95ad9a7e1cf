"""The command line: python -m planarimpact {rebound,history,compile,scene,models}."""

import argparse
import csv
import io
import json
import os
import sys
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from planarimpact import bodies, checks, continuum, ladder, lumped, response, whole_files
from planarimpact.arrays import ArrayLike
from planarimpact.results import ContinuumHistory, History, Regime

WORDS = """
What happens when a rough, elastic body strikes a surface at an angle?
Incidence is v1(0)/(mu v2(0)): tangential over normal speed, over friction. All velocities come in
mu v2(0), negative where the contact point has turned round.
"""
COLUMNS = """\
Columns, with units in the header, separated by commas; the order is free, all others are refused:
  radius [m]              distance from centre to contact point, and radius of curvature
  density [kg/m^3]        of a solid sphere; or else mass [kg] and gyration [m]
  young_modulus [Pa], poisson_ratio
  friction, restitution   of the pair
  the state before, in a plane:
    velocity_tangential [m/s], velocity_normal [m/s], positive towards the surface,
    spin [rad/s], positive where it moves the contact point of this body forward (backspin)
  or in space, for bodies that turn alike about every axis:
    velocity_x [m/s], _y, _z, spin_x [rad/s], _y, _z, and the unit normal normal_x, _y, _z
    from the surface to the body; 0, 0, 1 if left out. spin_x, _y, _z is the right-handed vector
    of angular velocity: with x along and z up, a plane state has spin_y = -spin.
  id                      any words, carried over as they are
The other body, if it is no rigid half-space at rest, has the same columns with other_ in front;
its velocities and spin have the directions of the first one's: positive other_spin turns the same
way round. A material alone makes it an elastic half-space; masses, radii of gyration and Young's
moduli may be inf.
The result has all these columns as they are, and then those of the state after.
Example:
  radius [m],density [kg/m^3],young_modulus [Pa],poisson_ratio,friction,restitution,\
velocity_tangential [m/s],velocity_normal [m/s],spin [rad/s]
  0.01,7800,207e9,0.3,0.2,0.8,0.5,1,0
"""
GROUPS = {
    "mass_ratio": (3.5, "m2/m1: 3.5 for a solid sphere, 2.5 for a thin shell, 3 for a disc"),
    "stiffness_ratio": (1.21, "zeta^2, normal over tangential stiffness: (2-nu)/(2(1-nu))"),
    "restitution": (1.0, "energetic coefficient e, 0 to 1"),
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command; returns the exit status: 0, or 2 for what cannot be done, said in a line.

    Examples
    --------
    >>> main(["rebound", "--incidence", "8", "--model", "rigid"])
    incidence,velocity,peak_friction,dissipation,regime
    8.0,1.0,1.0,9.0,SLIP_THROUGHOUT
    0
    """
    options = _parser().parse_args(arguments)
    try:
        options.command(options)
        sys.stdout.flush()
    except (checks.InputError, checks.ConvergenceError) as error:
        print(f"planarimpact: {error}", file=sys.stderr)
        return 2
    except BrokenPipeError:  # whoever reads our output has had enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except OSError as error:
        print(f"planarimpact: {error.filename or 'output'}: {error.strerror}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("planarimpact: interrupted, nothing is written", file=sys.stderr)
        return 130
    return 0


def _rebound(options: argparse.Namespace) -> None:
    x = options.incidence
    if options.angle is None:
        _refuse_given(options, ["friction"], "an incidence has it in it")
    else:
        x = bodies.incidence_from_angle(options.angle, options.friction or 1.0)
    if options.response:
        _refuse_given(options, ["model", "setting", *GROUPS], "a response has its own")
        found = response.load(options.response)(x)
    else:
        found = ladder.rebound(_model(options), x, **_groups(options), **_settings(options))
    columns = {"incidence": np.asarray(x), **found._asdict()}
    columns["regime"] = np.array([Regime(code).name for code in found.regime])
    if found.reversals is None:
        del columns["reversals"]
    _print(columns, options)


def _history(options: argparse.Namespace) -> None:
    groups = _groups(options)
    found: History | ContinuumHistory
    if _model(options) == "continuum":
        _refuse_given(options, ["samples"], "the continuum has a tolerance instead")
        checks.elastic(groups.pop("restitution", 1.0))
        given = {} if options.tolerance is None else {"tolerance": options.tolerance}
        found = continuum.history(options.incidence, **groups, **given)
    else:
        _refuse_given(options, ["tolerance"], "the lumped model is exact")
        given = {} if options.samples is None else {"samples": options.samples}
        found = lumped.history(options.incidence, **groups, **given)
    columns = {name: value for name, value in found._asdict().items() if name != "events"}
    _print(columns, options)


def _compile(options: argparse.Namespace) -> None:
    settings = _settings(options)
    if "tolerance" in settings:
        raise checks.InputError("--set tolerance: a response has one tolerance, --tolerance")
    built = response.compile(
        _model(options),
        incidence_max=options.incidence_max,
        tolerance=options.tolerance,
        **_groups(options),
        **settings,
    )
    built.save(options.output)
    print(f"{options.output}: {built}")


def _scene(options: argparse.Namespace) -> None:
    try:
        from planarimpact.scene import files, places  # here, as pandas takes its time
    except ImportError as error:
        raise checks.InputError(str(error)) from None
    target = places.target(options.output)
    progress = files.bar if sys.stderr.isatty() else None
    solver = files.solve(
        options.input, options.output, options.tolerance, options.skip_bad, progress=progress
    )
    # Nothing else may stand in a table on standard output.
    words = sys.stderr if target == places.target("-") else sys.stdout
    print(f"{target.name}: {solver.rows - len(solver.bad)} impacts", file=words)
    bad = places.beside(target)
    if solver.bad and bad:
        print(f"{bad.name}: {len(solver.bad)} bad rows left out", file=words)
    elif solver.bad:
        for row, problem in solver.bad:
            print(f"row {row}, left out: {problem}", file=sys.stderr)
    if options.explain:
        print(solver.explain(), file=words)


def _models(options: argparse.Namespace) -> None:
    columns = {"model": list(ladder.MODELS)}
    models = ladder.MODELS.values()
    columns["cost"] = [model.cost for model in models]
    columns["settings"] = [
        " ".join(f"{key}={value}" for key, value in model.settings.items()) for model in models
    ]
    columns["restitution"] = ["{:g} to {:g}".format(*model.restitution) for model in models]
    columns["valid"] = [model.valid for model in models]
    columns["source"] = [model.source for model in models]
    _print(columns, options)


def _model(options: argparse.Namespace) -> str:
    return options.model or "lumped"


def _groups(options: argparse.Namespace) -> dict[str, Any]:
    """Groups that were given; models have defaults for the others."""
    given = {name: getattr(options, name) for name in GROUPS}
    return {name: value for name, value in given.items() if value is not None}


def _refuse_given(options: argparse.Namespace, names: list[str], why: str) -> None:
    """Refuse options that would be ignored."""
    for name in names:
        if getattr(options, name) not in (None, []):
            option = "--set" if name == "setting" else "--" + name.replace("_", "-")
            raise checks.InputError(f"{option}: it does not apply, {why}")


def _settings(options: argparse.Namespace) -> dict[str, float]:
    """Settings of the model that were given, `NAME=NUMBER`."""
    settings = {}
    for text in options.setting:
        name, equals, number = text.partition("=")
        try:
            settings[name] = int(number) if number.isdigit() else float(number)
        except ValueError:
            equals = ""
        if not equals:
            raise checks.InputError(f"--set {text}: allowed is NAME=NUMBER, such as steps=256")
    ladder.refuse_unknown(ladder.get(_model(options)), settings)
    return settings


def _print(columns: Mapping[str, ArrayLike], options: argparse.Namespace) -> None:
    """Columns of equal length as CSV or JSON, to a file whole or not at all, or to the terminal."""
    plain = {name: np.asarray(values).tolist() for name, values in columns.items()}
    if options.format == "json":
        named = {name: [whole_files.or_null(x) for x in xs] for name, xs in plain.items()}
        text = json.dumps(named, indent=1) + "\n"
    else:
        buffer = io.StringIO()
        writer = csv.writer(buffer, lineterminator="\n")
        writer.writerow(plain)
        writer.writerows(zip(*plain.values(), strict=True))
        text = buffer.getvalue()
    if options.output is None:
        sys.stdout.write(text)
        return
    with whole_files.written(options.output) as partial:
        partial.write_text(text, encoding="utf-8")


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m planarimpact", description=WORDS)
    commands = parser.add_subparsers(required=True, metavar="command")

    rebound = commands.add_parser(
        "rebound", help="state at separation", description="State at separation." + WORDS
    )
    impact = rebound.add_mutually_exclusive_group(required=True)
    impact.add_argument("--incidence", type=float, nargs="+", metavar="X")
    impact.add_argument(
        "--angle", type=float, nargs="+", help="of incidence, degrees; see --friction"
    )
    rebound.add_argument("--friction", type=float, help="mu, for --angle [1]")
    rebound.add_argument("--response", metavar="FILE", help="use what `compile` has written")
    _add_model(rebound, list(ladder.MODELS))
    _add_output(rebound)
    rebound.set_defaults(command=_rebound)

    history = commands.add_parser(
        "history",
        help="forces and velocity over one contact",
        description="Forces and velocity over one contact, against time in that of compression."
        + WORDS,
    )
    history.add_argument("--incidence", type=float, required=True, metavar="X")
    history.add_argument("--samples", type=int, help="of lumped [400]")
    history.add_argument("--tolerance", type=float, help="of continuum [1e-4]")
    _add_model(history, ["lumped", "continuum"], settings=False)
    _add_output(history)
    history.set_defaults(command=_history)

    compiled = commands.add_parser(
        "compile",
        help="make a fast response of one pair of bodies",
        description="Make a response, a table of polynomials that gives the rebound of one pair of "
        "bodies in nanoseconds, and write it to a file." + WORDS,
    )
    compiled.add_argument("output", metavar="FILE", help="where to write it, JSON")
    compiled.add_argument("--tolerance", type=float, default=1e-6, help="[%(default)s]")
    compiled.add_argument("--incidence-max", type=float, default=20.0, help="[%(default)s]")
    _add_model(compiled, list(ladder.MODELS))
    compiled.set_defaults(command=_compile)

    scene = commands.add_parser(
        "scene",
        help="solve a table of impacts",
        description="Solve a table of impacts, one a row, each by the cheapest model that is good "
        "enough.",
        epilog=COLUMNS,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    scene.add_argument(
        "input",
        help="the table: a name that ends in .csv, .csv.gz or .parquet, a pipe, or - for standard "
        "input; pipes are CSV",
    )
    scene.add_argument(
        "output",
        help="the same table with the state after each impact: names as for the input, .json too, "
        "or - for standard output",
    )
    scene.add_argument(
        "--tolerance",
        type=float,
        default=1e-3,
        help="largest error: of the tangential velocity as a share of friction times normal speed, "
        "of friction as a share of its limit [%(default)s]; elastic pairs reach some 1e-8",
    )
    scene.add_argument(
        "--explain", action="store_true", help="say which model took how many, and why"
    )
    scene.add_argument(
        "--skip-bad",
        action="store_true",
        help="leave bad rows out, and list them in OUTPUT.bad.csv, or on standard error where the "
        "output is a pipe",
    )
    scene.set_defaults(command=_scene)

    models = commands.add_parser("models", help="list the models", description="The models.")
    _add_output(models)
    models.set_defaults(command=_models)
    return parser


def _add_model(parser: argparse.ArgumentParser, names: list[str], settings: bool = True) -> None:
    parser.add_argument("--model", choices=names, help="[lumped]")
    for name, (value, words) in GROUPS.items():
        option = "--" + name.replace("_", "-")
        parser.add_argument(option, type=float, help=f"{words} [{value}]")
    if settings:
        parser.add_argument(
            "--set",
            action="append",
            default=[],
            dest="setting",
            metavar="NAME=NUMBER",
            help="a setting of the model, see `models`",
        )


def _add_output(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--format", choices=["csv", "json"], default="csv", help="[%(default)s]")
    parser.add_argument("--output", metavar="FILE", help="instead of the terminal")


if __name__ == "__main__":
    sys.exit(main())
