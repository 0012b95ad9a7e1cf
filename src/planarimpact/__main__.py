"""The command line: python -m planarimpact {rebound,history,compile,scene,models}."""

import argparse
import contextlib
import csv
import io
import json
import os
import sys
from pathlib import Path

import numpy as np

from planarimpact import bodies, checks, continuum, ladder, lumped, response
from planarimpact.results import Regime

WORDS = """
What happens when a rough, elastic body strikes a surface at an angle?
Incidence is v1(0)/(mu v2(0)): tangential over normal speed, over friction. All velocities come in
mu v2(0), negative where the contact point has turned round.
"""
GROUPS = {
    "mass_ratio": (3.5, "m2/m1: 3.5 for a solid sphere, 2.5 for a thin shell, 3 for a disc"),
    "stiffness_ratio": (1.21, "zeta^2, normal over tangential stiffness: (2-nu)/(2(1-nu))"),
    "restitution": (1.0, "energetic coefficient e, 0 to 1"),
}


def main(arguments=None):
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
    except (checks.InputError, checks.ConvergenceError) as error:
        print(f"planarimpact: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"planarimpact: {error.filename}: {error.strerror}", file=sys.stderr)
        return 2
    except BrokenPipeError:  # whoever read our output has had enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return 0


def _rebound(options):
    x = options.incidence
    if options.angle is not None:
        x = bodies.incidence_from_angle(options.angle, options.friction)
    if options.response:
        if options.setting or any(getattr(options, k) != v for k, (v, _) in GROUPS.items()):
            raise checks.InputError(
                f"{options.response}: a response has its own groups and settings"
            )
        found = response.load(options.response)(x)
    else:
        found = ladder.rebound(options.model, x, **_groups(options), **_settings(options))
    columns = {"incidence": np.asarray(x), **found._asdict()}
    columns["regime"] = np.array([Regime(code).name for code in found.regime])
    if found.reversals is None:
        del columns["reversals"]
    _print(columns, options)


def _history(options):
    if options.model == "continuum":
        groups = _groups(options)
        checks.elastic(groups.pop("restitution"))
        found = continuum.history(options.incidence, **groups, tolerance=options.tolerance)
        columns = found._asdict()
    else:
        found = lumped.history(options.incidence, **_groups(options), samples=options.samples)
        columns = {name: value for name, value in found._asdict().items() if name != "events"}
    _print(columns, options)


def _compile(options):
    built = response.compile(
        options.model,
        incidence_max=options.incidence_max,
        tolerance=options.tolerance,
        **_groups(options),
        **_settings(options),
    )
    built.save(options.output)
    print(f"{options.output}: {built}")


def _scene(options):
    from planarimpact.scene import files  # pandas takes its time

    progress = files.bar if sys.stderr.isatty() else None
    solver = files.solve(
        options.input, options.output, options.tolerance, options.skip_bad, progress=progress
    )
    print(f"{options.output}: {solver.rows - len(solver.bad)} impacts")
    if solver.bad:
        print(f"{options.output}.bad.csv: {len(solver.bad)} bad rows left out")
    if options.explain:
        print(solver.explain())


def _models(options):
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


def _groups(options):
    return {name: getattr(options, name) for name in GROUPS}


def _settings(options):
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
    return settings


def _print(columns, options):
    """Columns of equal length as CSV or JSON, to a file whole or not at all, or to the terminal."""
    plain = {name: np.asarray(values).tolist() for name, values in columns.items()}
    if options.format == "json":
        # JSON knows no NaN: what a model leaves open is null.
        text = json.dumps({k: [_or_null(x) for x in v] for k, v in plain.items()}, indent=1) + "\n"
    else:
        buffer = io.StringIO()
        writer = csv.writer(buffer, lineterminator="\n")
        writer.writerow(plain)
        writer.writerows(zip(*plain.values(), strict=True))
        text = buffer.getvalue()
    if options.output is None:
        sys.stdout.write(text)
        return
    partial = Path(f"{options.output}.partial")
    try:
        partial.write_text(text, encoding="utf-8")
        partial.replace(options.output)
    finally:
        with contextlib.suppress(OSError):
            partial.unlink(missing_ok=True)


def _or_null(value):
    return None if isinstance(value, float) and not np.isfinite(value) else value


def _parser():
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
    rebound.add_argument(
        "--friction", type=float, default=1.0, help="mu, for --angle [%(default)s]"
    )
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
    history.add_argument("--samples", type=int, default=400, help="of lumped [%(default)s]")
    history.add_argument("--tolerance", type=float, default=1e-4, help="of continuum [%(default)s]")
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
        "enough. `python -c 'import planarimpact.scene as s; help(s.solve)'` lists the columns.",
    )
    scene.add_argument("input", help="the table, CSV or .parquet")
    scene.add_argument("output", help="the table after the impacts")
    scene.add_argument(
        "--tolerance",
        type=float,
        default=1e-3,
        help="largest error, in mu v2(0) of velocity and in mu F2max of friction [%(default)s]",
    )
    scene.add_argument(
        "--explain", action="store_true", help="say which model took how many, and why"
    )
    scene.add_argument(
        "--skip-bad",
        action="store_true",
        help="leave bad rows out, and list them beside the output",
    )
    scene.set_defaults(command=_scene)

    models = commands.add_parser("models", help="list the models", description="The models.")
    _add_output(models)
    models.set_defaults(command=_models)
    return parser


def _add_model(parser, names, settings=True):
    parser.add_argument("--model", default="lumped", choices=names, help="[%(default)s]")
    for name, (value, words) in GROUPS.items():
        option = "--" + name.replace("_", "-")
        parser.add_argument(option, type=float, default=value, help=f"{words} [%(default)s]")
    if settings:
        parser.add_argument(
            "--set",
            action="append",
            default=[],
            dest="setting",
            metavar="NAME=NUMBER",
            help="a setting of the model, see `models`",
        )


def _add_output(parser):
    parser.add_argument("--format", choices=["csv", "json"], default="csv", help="[%(default)s]")
    parser.add_argument("--output", metavar="FILE", help="instead of the terminal")


if __name__ == "__main__":
    sys.exit(main())
