"""No page stops with an error in Firefox, if it is installed.

An error empties a copy of its page, which then is blank in a picture by Firefox.
"""

import io
import shutil
import subprocess

import pytest
from matplotlib.image import imread

from tests.workflow.test_pages import BAR

NAMES = ("firefox", "firefox-esr")
# What a script does not catch, as it is loaded or later.
TRAP = """<script>for (const kind of ["error", "unhandledrejection"]) {
addEventListener(kind, () => document.documentElement.replaceChildren()); }</script>"""
WIDTH, HEIGHT = 900, 500  # of each page in the picture


def pictures(folder, names, profile):
    """Copies of pages as Firefox shows them, one below the other in one window."""
    program = next(filter(None, map(shutil.which, NAMES)), None)
    if program is None:
        pytest.skip(f"none of {', '.join(NAMES)} is installed")
    for name in names:
        page = (folder / name).read_text(encoding="utf-8")
        assert "<head>" in page
        (folder / name).write_text(page.replace("<head>", f"<head>{TRAP}", 1), encoding="utf-8")
    frames = "".join(
        f'<iframe src="{name}" style="border: 0; display: block" width="{WIDTH}" '
        f'height="{HEIGHT}"></iframe>'
        for name in names
    )
    all_pages, shot = folder / "all.html", profile / "shot.png"
    all_pages.write_text(f'<!doctype html><body style="margin: 0">{frames}')
    size = f"{WIDTH},{len(names) * HEIGHT}"
    order = [program, "--headless", "--no-remote", "--profile", str(profile)]
    order += ["--window-size", size, "--screenshot", str(shot), all_pages.as_uri()]
    subprocess.run(order, check=True, capture_output=True, timeout=120)
    picture = imread(io.BytesIO(shot.read_bytes()))[..., :3]
    assert picture.shape == (len(names) * HEIGHT, WIDTH, 3)
    return picture.reshape(len(names), HEIGHT, WIDTH, 3)


def is_drawn(picture):
    return picture.std() > 0.05


def test_the_explorer_runs_in_firefox(explorer, tmp_path):
    page = explorer.read_text(encoding="utf-8")
    (tmp_path / "explorer.html").write_text(page, encoding="utf-8")
    old = "const stage = (() => {"
    assert old in page
    wrong = page.replace(old, f"{old} missing();")
    (tmp_path / "wrong.html").write_text(wrong, encoding="utf-8")
    profile = tmp_path / "profile"
    profile.mkdir()
    right, wrong = pictures(tmp_path, ["explorer.html", "wrong.html"], profile)
    assert is_drawn(right) and not is_drawn(wrong)


def test_every_page_runs_in_firefox(first_run, tmp_path):
    folder = shutil.copytree(first_run[0] / "figures", tmp_path / "figures")
    profile = tmp_path / "profile"
    profile.mkdir()
    shown = pictures(folder, BAR, profile)
    assert [name for name, one in zip(BAR, shown, strict=True) if not is_drawn(one)] == []
