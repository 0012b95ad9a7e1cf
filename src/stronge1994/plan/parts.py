"""A scene in many tables, before it runs: which tables there are, and what they hold."""

import os
import re
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any

from stronge1994.plan.config import Config, ConfigError

# What scenes read, the longer ending of two that fit first.
ENDINGS = (".csv.gz", ".csv", ".parquet")
RESULTS = "results/scene_parts"
# Names become names of files, of jobs on a cluster and of wildcards.
NAME = re.compile(r"[\w.=+-]+")


def settings(config: Config) -> dict[str, Any]:
    """How each table is solved: what `scene_parts.solve` takes beside files."""
    return {"loss": None} | {k: v for k, v in config["scene_parts"].items() if k != "tables"}


def tables(config: Config) -> dict[str, str]:
    """Tables of the scene: `{name: path}`, in order; none if the config names no folder.

    `scene_parts.tables` of the config is a folder, each entry of which is a table, or a pattern for
    the names in a folder. Hidden entries do not count. `~` is the home of the user.
    """
    if "tables" not in config["scene_parts"]:
        return {}
    folder, pattern = _folder(config)
    visible = (entry for entry in sorted(folder.glob(pattern)) if entry.name[0] != ".")
    return {entry.name: str(entry) for entry in visible}


def check(config: Config, found: Mapping[str, str]) -> None:
    """Refuse what `tables` found in a folder if one of it cannot be solved, or if nothing is there.

    Jobs on a cluster look into the folder too, and do not check it: tables may be added meanwhile.
    """
    if "tables" not in config["scene_parts"]:
        return
    (folder, _), where = _folder(config), f"config: scene_parts.tables = {_named(config)!r}"
    if not folder.is_dir():
        raise ConfigError(f"{where}: there is no folder {folder}")
    if folder.resolve().is_relative_to(Path(RESULTS).resolve()):
        raise ConfigError(f"{where}: results are written there; tables need another folder")
    if re.search("[{}]", str(folder)):
        raise ConfigError(f"{where}: allowed is a folder without braces in its name")
    allowed = f"files that end in {' or '.join(ENDINGS)}"
    if not found:
        raise ConfigError(f"{where}: no table; allowed are {allowed}")
    known: dict[str, str] = {}  # by the name without its ending
    for name, path in found.items():
        ending = next((end for end in ENDINGS if name.lower().endswith(end)), "")
        if not ending or not Path(path).is_file():
            raise ConfigError(
                f"{where}: {name} is no table; allowed are {allowed}; a pattern such as "
                f"{folder}/*.csv leaves others out"
            )
        if not NAME.fullmatch(name):
            raise ConfigError(f"{where}: {name}: allowed are letters, digits and _ . = + -")
        if not os.access(path, os.R_OK):
            raise ConfigError(f"{where}: {name}: you may not read it")
        twin = known.setdefault(name[: -len(ending)], name)
        if twin != name:
            raise ConfigError(
                f"{where}: {twin} and {name} differ only by their endings; allowed is one of them"
            )


def _named(config: Config) -> str:
    return str(config["scene_parts"]["tables"])


def _folder(config: Config) -> tuple[Path, str]:
    """The folder of the tables, and a pattern for their names."""
    path = Path(_named(config)).expanduser()
    if re.search(r"[*?[]", path.name) and not path.is_dir():
        return path.parent, path.name
    return path, "*"


def refuse_unusable(found: Collection[str]) -> None:
    """Refuse no tables, and results of others: who reads the folder of results would count them."""
    if not found:
        raise ConfigError("config: scene_parts.tables: not there; allowed is a folder of tables")
    strays = sorted({path.name for path in Path(RESULTS, "tables").glob("*")} - set(found))
    if strays:
        raise ConfigError(
            f"{RESULTS}/tables/{strays[0]}: config: scene_parts.tables has no table of this name "
            f"(any more): move the result away or remove it ({len(strays)} such files)"
        )
