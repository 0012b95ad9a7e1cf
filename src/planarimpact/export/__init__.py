"""Collisions of spheres in other languages: a header of C99, or a module of JavaScript.

The file needs no other file; for TypeScript, a second one has the types of the module. Its head
says what it computes, in which units, to which error. Both languages evaluate as
`planarimpact.spheres` does: the same operations in the same order. Restitution by speed is written
with roots alone, as the last digit of other powers differs between languages. Numbers are stored as
in the shipped table: whole numbers, each times a power of 1/2.

`templates` has the code of each language, and spheres.txt the words that both have. What stands
between two marks, such as `<public>` and `</public>`, is written once for each row of the block of
this name, with the row's values for its `$names`.
"""

import base64
import re
import string
import textwrap
from collections.abc import Mapping
from contextlib import ExitStack
from importlib import resources
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from planarimpact import __version__, spheres
from planarimpact.collision import RESTITUTION_FROM
from planarimpact.collision.presets import Preset, presets
from planarimpact.common import checks, files
from planarimpact.common.arrays import Array, ArrayLike, Integers
from planarimpact.common.checks import InputError
from planarimpact.common.results import Regime
from planarimpact.normal_impact import LEAST_RESTITUTION, kelvin_voigt
from planarimpact.spheres import table as tables
from planarimpact.spheres.table import LEFT, ORDER, PACKED, RIGHT, ROOTS, Table

# Endings of the names of files by language; its template has the first.
LANGUAGES = {"c": (".h",), "js": (".mjs", ".js")}
# Largest errors of the shipped tables by loss, and the tables by the larger of them.
BOUNDS = {"fine": spheres.ERROR_BOUND, "coarse": {"viscous": 3e-3, "plastic": 4e-2}}
TABLES: dict[float, str] = {max(bounds.values()): name for name, bounds in BOUNDS.items()}
# A name in C, and not one of those that begin with an underscore: C reserves many of them.
IDENTIFIER = re.compile(r"[A-Za-z][A-Za-z0-9_]*", re.ASCII)
# Lines with the marks of a block, and what is between them.
BLOCK = re.compile(r"^[^\n]*<(\w+)>[^\n]*\n(.*?)^[^\n]*</\1>[^\n]*\n", re.MULTILINE | re.DOTALL)
# Numbers in a line of a table, and letters in a line of a comment.
NUMBERS, WIDTH = 12, 99
# Numbers of a pair of materials.
PAIR = ("friction", "stiffness_ratio", *RESTITUTION_FROM, "effective_modulus")
# Blocks of comments, the sections of spheres.txt.
WORDS = "about", "constants", "table"

# Rows of values by name.
Block: TypeAlias = list[dict[str, Any]]


def write_spheres(path: str | Path, language: str, tolerance: float = min(TABLES)) -> None:
    """Write collisions of spheres as code, by the table of spheres; whole or not at all.

    The code computes what `planarimpact.collide` computes, and without vectors what
    `planarimpact.spheres.rebound` computes. Where the table has no answer, the regime is
    UNRESOLVED, and numbers that are not known are NaN; but `collide`, `bounce` and `model_form` of
    JavaScript throw a RangeError for bad arguments, and in C `NAME_problem` says what is wrong.
    Both languages give the same bits. With the default tolerance `collide` gives the same
    velocities to rounding; only within 0.02 % of the incidence from which metal slides throughout
    they differ, by up to 0.001 mu v2(0).

    Parameters
    ----------
    path : str or Path
        "c": NAME.h, with the functions `NAME_collide`, `NAME_bounce`, `NAME_rebound` and more;
        NAME has letters from A to Z, digits and underscores, and begins with a letter. "js":
        NAME.mjs or NAME.js, with `collide` and so on, and beside it NAME.d.mts or NAME.d.ts, its
        types for TypeScript. A file that is there is replaced.
    language : str
        A key of `LANGUAGES`: "c", also for C++, or "js".
    tolerance : float
        A key of `TABLES`: the largest error. That of the table in this package is the smaller one.

    Raises
    ------
    InputError
        If there is no such language or no table of this tolerance, the name is not allowed, or
        there can be no such file.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "spheres.mjs"
    >>> write_spheres(path, "js", tolerance=max(TABLES))
    >>> "export function collide(" in path.read_text()
    True
    """
    if not isinstance(path, (str, Path)):
        raise InputError(f"path = {checks.brief(path)}: allowed is the name of a file")
    file = Path(path)
    _refuse_name(file, language)
    allowed = " or ".join(f"{error:g}" for error in TABLES)
    if checks.number("tolerance", tolerance, allowed) not in TABLES:
        raise InputError(f"tolerance = {checks.brief(tolerance)}: allowed is {allowed}")
    by_template = {f"spheres{LANGUAGES[language][0]}": file}
    if language == "js":
        types = file.with_suffix(".d" + file.suffix.lower().replace("j", "t"))
        by_template["spheres.d.mts"] = types
    texts = _code(TABLES[tolerance], by_template, language)
    with ExitStack() as stack:  # all are whole before one has its name
        for path, text in zip(by_template.values(), texts, strict=True):
            stack.enter_context(files.written(path)).write_text(text, encoding="utf-8")


def _refuse_name(file: Path, language: str) -> None:
    """Refuse a language, an ending of another one, or a name that functions in C cannot have."""
    endings = LANGUAGES[checks.word("language", language, LANGUAGES)]
    name = file.parent / checks.in_ascii(file.name)
    if file.suffix.lower() not in endings:
        raise InputError(f"{name}: allowed are names that end in {' or '.join(endings)}")
    if language == "c" and not IDENTIFIER.fullmatch(file.stem):
        raise InputError(
            f"{name}: allowed are names of letters from A to Z, digits and underscores, a letter "
            "first, as the functions have this name"
        )


def _code(table_name: str, by_template: Mapping[str, Path], language: str) -> list[str]:
    """The texts of files: their templates, with the names and blocks of these files."""
    names = {template: file.name for template, file in by_template.items()}
    prefix = f"{next(iter(by_template.values())).stem}_" if language == "c" else ""
    names |= {"spheres_": prefix, "SPHERES_": prefix.upper()}

    def read(text_file: str) -> str:
        """A file of the templates, with the names of this file."""
        text = resources.files(__package__).joinpath("templates", text_file).read_text("utf-8")
        return re.sub("|".join(map(re.escape, names)), lambda match: names[match[0]], text)

    table = tables.shipped(table_name)
    blocks: dict[str, Block] = {
        name: [{"text": "\n".join(map(_comment, words.splitlines()))}]
        for name, words in zip(WORDS, read("spheres.txt").split("\n---\n"), strict=True)
    }
    blocks["version"] = [{"value": __version__}]
    blocks["public"] = _constants(_public(BOUNDS[table_name]))
    blocks["private"] = _constants(_private(table))
    blocks |= _laid_out(table, language)
    blocks["presets"] = [_preset(*item, prefix.upper()) for item in presets().items()]

    def written(match: re.Match[str]) -> str:
        block = string.Template(match[2])
        return "".join(block.substitute(row) for row in blocks[match[1]])

    return [BLOCK.sub(written, read(template)) for template in by_template]


def _comment(paragraph: str) -> str:
    """Lines of a comment, all with the indent of the first; a number such as 1e-05 stays in one."""
    indent = " * " + paragraph[: len(paragraph) - len(paragraph.lstrip())]
    lines = textwrap.wrap(
        paragraph.strip(),
        WIDTH,
        initial_indent=indent,
        subsequent_indent=indent,
        break_on_hyphens=False,
        break_long_words=False,
    )
    return "\n".join(lines or [" *"])


def _constants(values: Mapping[str, float]) -> Block:
    """Constants by name, with all digits, so that they are read as the same float64."""
    return [{"name": name, "value": value} for name, value in values.items()]


def _public(bounds: Mapping[str, float]) -> dict[str, float]:
    """Public constants: losses, range, errors and the codes of regimes."""
    return {
        # 0 is none of them, so that a loss which nobody states is not taken for one.
        **{loss.upper(): code for code, loss in enumerate(spheres.LOSSES, 1)},
        "INCIDENCE_MAX": checks.LARGEST,
        **_by_loss("RESTITUTION_MIN", spheres.LEAST_RESTITUTION),
        "STIFFNESS_MAX": spheres.LARGEST_STIFFNESS,
        "RATIO_MIN": spheres.LEAST_RATIO,
        "RATIO_MAX": spheres.LARGEST_RATIO,
        **_by_loss("ERROR", bounds),
        "STIFFNESS_STATED": spheres.STATED_STIFFNESS,
        **{regime.name: regime.value for regime in Regime},
    }


def _by_loss(name: str, values: Mapping[str, float]) -> dict[str, float]:
    """A constant for each loss."""
    return {f"{name}_{loss.upper()}": value for loss, value in values.items()}


def _private(table: Table) -> dict[str, float]:
    """Constants that the functions use."""
    return {
        **_by_loss("B_LEAST", {loss: b for loss, (b, _, _) in tables.SPANS.items()}),
        **_by_loss("B_SPAN", {loss: most - b for loss, (b, most, _) in tables.SPANS.items()}),
        **_by_loss("E_LEAST", {loss: e for loss, (_, _, e) in tables.SPANS.items()}),
        "UNIT": 2.0**-table.exponent,
        "INCIDENCE_LEAST": checks.LEAST_INCIDENCE,
        "MASS_RATIO_MOST": checks.LARGEST,
        "STIFFNESS_MOST": spheres.LARGEST_STIFFNESS * (1 + spheres.ROUNDING),
        "RATIO_LEAST": spheres.LEAST_RATIO * (1 - spheres.ROUNDING),
        "RATIO_MOST": spheres.LARGEST_RATIO * (1 + spheres.ROUNDING),
        "NEARLY": tables.NEARLY,
        "LEFT": LEFT,
        "RIGHT": RIGHT,
        "INTERVALS": table.limits.shape[1] - 1,
        "LEAST": LEAST_RESTITUTION,
        "LONGEST": float(kelvin_voigt.relaxation_time(np.array(LEAST_RESTITUTION))),
        "SERIES": len(_series()),
        "SPAN": float(kelvin_voigt.series().domain[1]),
        "LENGTH_ERROR": checks.LENGTH_ERROR,
    }


def _series() -> Array:
    """Viscous restitution over the root of the relaxation time, from 0 to SPAN."""
    return np.asarray(kelvin_voigt.series().trim(kelvin_voigt.SMALL_TERM).coef, float)


def _laid_out(table: Table, language: str) -> dict[str, Block]:
    """The table: fields of panels, rows of patches, and edges and splines, one after the other."""
    panels: list[list[int]] = []
    patches: list[tuple[int, int, int]] = []
    values: list[Integers] = []
    for name, panel in table.panels.items():
        over_t, over_u = panel.velocity.shape[1:]
        varying, rows, columns = panel.edges.shape
        row = [len(patches), len(ROOTS[name]), varying, rows - 1, columns - 1, over_t, over_u]
        for field in PACKED:
            part = tables.whole(getattr(panel, field), table.exponent)
            row.append(sum(map(np.size, values)) if part.size else -1)
            values += [part] if part.size else []
        panels.append(row)
        first = np.cumsum([0, *panel.intervals + ORDER - 1])
        patches += zip(ROOTS[name], panel.intervals.tolist(), first.tolist(), strict=False)
    blocks = {
        "limits": _lines(table.limits),
        "panels": [{"row": ",".join(map(str, row))} for row in panels],
        "patches": _lines(patches),
        "series": _lines(_series()),
    }
    if language == "c":
        return blocks | {"values": _lines(np.concatenate([part.ravel() for part in values]))}
    shapes = [{"row": ",".join(map(str, part.shape))} for part in values]
    return blocks | {"shapes": shapes, "packed": [{"text": _packed(values)}]}


def _lines(numbers: ArrayLike) -> Block:
    """Numbers with all digits, some in each line."""
    words = list(map(str, np.ravel(numbers).tolist()))
    return [{"numbers": ",".join(words[i : i + NUMBERS])} for i in range(0, len(words), NUMBERS)]


def _packed(values: list[Integers]) -> str:
    """The values for JavaScript, as `unfolded` reads them: small differences take one byte."""
    steps = np.concatenate([tables.steps(part).ravel() for part in values]).astype(np.int64)
    bits = np.where(steps < 0, -2 * steps - 1, 2 * steps)[:, None] >> 7 * np.arange(5)
    goes_on = bits[:, 1:] > 0
    digits = bits % 128
    digits[:, :-1] += 128 * goes_on
    used = np.pad(goes_on, ((0, 0), (1, 0)), constant_values=True)
    return base64.b64encode(digits[used].astype(np.uint8).tobytes()).decode()


def _preset(name: str, preset: Preset, prefix: str) -> dict[str, Any]:
    """A body with its pair. A number that a pair leaves out is 0, as is its loss."""
    words = f"{preset.about}. Numbers: {preset.source}.", f"Caveat: {preset.caveat}"
    pair = {field: float(np.nan_to_num(getattr(preset.pair, field))) for field in PAIR}
    loss: str | int = 0
    if pair["restitution"]:
        loss = f"{prefix}{preset.pair.loss}".upper()
    body = {field: float(getattr(preset.body, field)) for field in preset.body._fields}
    return {"text": "\n".join(map(_comment, words)), "name": name, "loss": loss} | body | pair
