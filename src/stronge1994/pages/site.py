"""The pages of a run in one folder, for a web server or a USB stick."""

import shutil
from collections.abc import Iterable
from pathlib import Path

from stronge1994.pages import templates


def write(folder: str, pages: Iterable[str], texts: Iterable[str]) -> None:
    """Copy pages (files and folders of figures/) and texts.

    The start page links to the interface here: only the site has it.
    """
    site = Path(folder)
    site.mkdir(parents=True)
    for path in map(Path, pages):
        copy = site / path.relative_to("figures")
        if path.is_dir():
            # Snakemake puts a file of its own into a folder that a job has made.
            shutil.copytree(path, copy, ignore=shutil.ignore_patterns(".*"))
        else:
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(path, copy)
    page = templates.environment().get_template("index.html")
    text = page.render(interface="interface/planarimpact.html")
    (site / "index.html").write_text(text, encoding="utf-8")
    for text in texts:
        shutil.copy2(text, site)


def pack(folder: str, archive: str) -> None:
    """Pack a folder into a zip file, from which it comes out with its name."""
    site = Path(folder)
    shutil.make_archive(archive.removesuffix(".zip"), "zip", site.parent, site.name)
