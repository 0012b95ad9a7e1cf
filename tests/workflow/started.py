"""What the process of a start does: it imports nothing of this project, whose copy it runs."""

import os
import sys

# What Snakemake and our Snakefile import on their way: it is imported once, which saves seconds.
PRELOADED = ["snakemake.cli", "snakemake.report.html_reporter", "nbformat", "numpy", "pandas"]
PRELOADED += ["scipy.integrate", "scipy.interpolate", "smart_open"]


def start(folder, arguments, words):
    """Do what `python -m snakemake` does in a folder of an activated environment."""
    os.setsid()
    os.chdir(folder)
    os.environ["PATH"] = f"{os.path.dirname(sys.executable)}:{os.environ['PATH']}"
    for number in (1, 2):
        os.dup2(os.open(words, os.O_WRONLY | os.O_APPEND), number)
    sys.argv = ["snakemake", *arguments]

    from snakemake import cli

    cli.main(arguments)
