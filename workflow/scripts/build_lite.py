"""Build a web site on which the notebooks of students run in the browser, by JupyterLite."""

from stronge1994 import logs

logs.to(snakemake.log[0])

import importlib.util
import json
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from importlib import metadata
from pathlib import Path

if not importlib.util.find_spec("jupyterlite_pyodide_kernel"):
    sys.exit("JupyterLite is missing: .venv/bin/python -m pip install -r workflow/envs/lite.txt")
with tempfile.TemporaryDirectory() as folder:
    files, wheels = Path(folder, "files"), Path(folder, "pypi")
    for path in (files, wheels):
        path.mkdir()
    for path in snakemake.input.files:
        shutil.copy(path, files)
    # Pyodide lacks this package, which its kernel needs: else that asks the network for it.
    comm = metadata.distribution("comm")
    with zipfile.ZipFile(wheels / f"comm-{comm.version}-py3-none-any.whl", "w") as wheel:
        for path in comm.files:
            if path.suffix != ".pyc":
                wheel.write(path.locate(), path)
    # What the first cells would install is loaded as the kernel starts, by a path that its script
    # sees: a cell could not read a file of the site if the address is http and not https.
    texts = [path.read_text(encoding="utf-8") for path in files.glob("*.ipynb")]
    lines = re.findall(r'%pip install -q \./(\S+) (.*?)\\n"', "\n".join(texts))
    packages = {f"../../../../files/{wheel}" for wheel, _ in lines}
    packages |= {name for _, names in lines for name in names.split()}
    kernel = {"loadPyodideOptions": {"packages": sorted(packages)}}
    if snakemake.params.pyodide_url:
        kernel["pyodideUrl"] = snakemake.params.pyodide_url
    settings = {"litePluginSettings": {"@jupyterlite/pyodide-kernel-extension:kernel": kernel}}
    config = {"jupyter-lite-schema-version": 0, "jupyter-config-data": settings}
    Path(folder, "jupyter-lite.json").write_text(json.dumps(config), encoding="utf-8")
    options = ["--lite-dir", folder, "--contents", str(files), "--output-dir"]
    options += [str(Path(snakemake.output[0]).resolve()), "--apps", "lab", "--apps", "notebooks"]
    options += ["--no-sourcemaps", "--no-unused-shared-packages"]
    command = [sys.executable, "-m", "jupyterlite_core", "build", *options]
    subprocess.run(command, cwd=folder, check=True, stdout=sys.stdout, stderr=sys.stdout)
