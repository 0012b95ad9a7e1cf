"""Build the wheel of the package in a copy of its files: the same bytes from the same files."""

from stronge1994 import logs

logs.to(snakemake.log[0])

import contextlib
import os
import shutil
import tempfile
from pathlib import Path

from setuptools import build_meta

os.umask(0o022)  # the wheel has the rights of its files
os.environ["SOURCE_DATE_EPOCH"] = "0"  # and their dates
folder = Path(snakemake.output[0]).parent.resolve()
with tempfile.TemporaryDirectory() as copy:
    for path in snakemake.input.source:
        Path(copy, path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, Path(copy, path))
    with contextlib.chdir(copy):
        build_meta.build_wheel(folder)
