"""A scene in many tables, before it runs: which tables there are, and what they hold."""

import hashlib
import json
import os
import re
from collections.abc import Collection
from pathlib import Path
from typing import Any

from planarimpact.ground import files
from stronge1994 import records
from stronge1994.plan.config import Config, ConfigError

# What scenes read, the longer ending of two that fit first.
ENDINGS = (".csv.gz", ".csv")
RESULTS = "results/scene_parts"
# Names become names of files, of jobs on a cluster and of wildcards.
NAME = re.compile(r"[\w.=+-]+")
# Fingerprints of tables, to be kept until a table changes.
KEPT = records.FOLDER / "scene_parts"


def settings(config: Config) -> dict[str, Any]:
    """How each table is solved: what `scene_parts.solve` takes beside files."""
    return {"loss": None} | {k: v for k, v in config["scene_parts"].items() if k != "tables"}


def tables(config: Config) -> dict[str, str]:
    """Tables of the scene: `{name: path}`, in order; none if the config names no folder.

    Parameters
    ----------
    config : dict
        Its `scene_parts.tables` is a folder, each visible file of which is a table, or a pattern
        for the names in a folder. `~` is the home of the user.

    Returns
    -------
    dict

    Raises
    ------
    ConfigError
        If there is no such folder or no table in it, if a file is none that scenes read or has a
        name that is not allowed, or if two differ only by their endings.
    """
    named = config["scene_parts"].get("tables")
    if named is None:
        return {}
    where, path = f"config: scene_parts.tables = {named!r}", Path(named).expanduser()
    pattern = re.search(r"[*?[]", path.name) is not None
    folder = path.parent if pattern else path
    if not folder.is_dir():
        raise ConfigError(f"{where}: there is no folder {folder}")
    if folder.resolve().is_relative_to(Path(RESULTS).resolve()):
        raise ConfigError(f"{where}: results are written there; tables need another folder")
    entries = sorted(folder.glob(path.name if pattern else "[!.]*"))
    if not entries:
        raise ConfigError(
            f"{where}: no table; allowed are names that end in {' or '.join(ENDINGS)}"
        )
    found: dict[str, Path] = {}  # by the name without its ending
    for entry in entries:
        ending = next((end for end in ENDINGS if entry.name.lower().endswith(end)), "")
        if not ending or not entry.is_file():
            raise ConfigError(
                f"{where}: {entry.name} is no table; allowed are files that end in "
                f"{' or '.join(ENDINGS)}; a pattern such as {folder}/*.csv leaves others out"
            )
        if not NAME.fullmatch(entry.name) or re.search("[{}]", str(folder)):
            raise ConfigError(
                f"{where}: {entry}: allowed in the name are letters, digits and _ . = + -, and in "
                "its folder everything but braces"
            )
        if not os.access(entry, os.R_OK):
            raise ConfigError(f"{where}: {entry.name}: you may not read it")
        twin = found.setdefault(entry.name[: -len(ending)], entry)
        if twin is not entry:
            raise ConfigError(
                f"{where}: {twin.name} and {entry.name} differ only by their endings; allowed is "
                "one of them"
            )
    return {entry.name: str(entry) for entry in entries}


def refuse_unusable(found: Collection[str]) -> None:
    """Refuse no tables, and results of others: who reads the folder of results would count them.

    Parameters
    ----------
    found : collection of str
        Names of the tables.

    Raises
    ------
    ConfigError
        Naming what to set, or the first of these results.
    """
    if not found:
        raise ConfigError("config: scene_parts.tables: not there; allowed is a folder of tables")
    strays = sorted({path.name for path in Path(RESULTS, "tables").glob("*")} - set(found))
    if strays:
        raise ConfigError(
            f"{RESULTS}/tables/{strays[0]}: config: scene_parts.tables has no table of this name "
            f"(any more): move the result away or remove it ({len(strays)} such files)"
        )


def content(table: str) -> str:
    """Fingerprint of what a table holds. It is read again only if its size or times have changed.

    Snakemake asks at each start, and the tables of a large scene take minutes to read.
    """
    status, kept = os.stat(table), KEPT / f"{Path(table).name}.json"
    size, times = status.st_size, [status.st_mtime_ns, status.st_ctime_ns]
    mark = {"path": os.path.abspath(table), "size": size, "times": times, "file": status.st_ino}
    try:
        known = json.loads(kept.read_text(encoding="utf-8"))
        if known["mark"] == mark:
            return str(known["sha256"])
    except (OSError, ValueError, TypeError, KeyError):
        pass  # it is read for the first time, or the note on it is damaged
    with open(table, "rb") as file:
        sha256 = hashlib.file_digest(file, "sha256").hexdigest()
    kept.parent.mkdir(parents=True, exist_ok=True)
    with files.written(kept) as partial:
        partial.write_text(json.dumps({"mark": mark, "sha256": sha256}))
    return sha256
