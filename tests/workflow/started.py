"""A process that has imported Snakemake once, and forks for each start: this saves seconds each.

It imports nothing of this project, so a start takes the sources of its own folder. It reads lines
`["start", folder, arguments, file for what is printed]`, answered by the process id, and
`["wait", process id]`, answered by the exit code.
"""

import importlib
import json
import os
import sys

from snakemake import cli

# What Snakemake and our Snakefile import on their way.
LATER = ["nbformat", "numpy", "pandas", "scipy.integrate", "scipy.interpolate", "smart_open"]


def start(folder, arguments, words):
    """Do what `python -m snakemake` does in a folder, and end this process with it."""
    os.setsid()
    os.chdir(folder)
    given = os.open(os.devnull, os.O_RDONLY)
    printed = os.open(words, os.O_WRONLY)
    for number, file in enumerate((given, printed, printed)):
        os.dup2(file, number)
    sys.argv = ["snakemake", *arguments]
    cli.main(arguments)


if __name__ == "__main__":
    cli.get_argument_parser()  # it imports all plugins
    for name in LATER:
        importlib.import_module(name)
    for line in sys.stdin:
        what, *given = json.loads(line)
        if what == "wait":
            answer = os.waitstatus_to_exitcode(os.waitpid(*given, 0)[1])
        elif not (answer := os.fork()):
            start(*given)
        print(answer, flush=True)
