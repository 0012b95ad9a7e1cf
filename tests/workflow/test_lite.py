"""The notebooks of students in the browser: needs JupyterLite, and the last test Pyodide, too."""

import functools
import importlib.util
import json
import os
import socket
import threading
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer

import pytest

from stronge1994 import versions
from tests.workflow import browser
from tests.workflow.project import LEFT, PARTS, copy_of

# A folder with an own copy of Pyodide can be named in this variable.
PYODIDE = os.environ.get("PYODIDE_FOLDER")
ALONE = {"--config=lite={pyodide_url: ./pyodide/pyodide.mjs}"} if PYODIDE else set()


@pytest.fixture(scope="module")
def site(first_run, tmp_path_factory):
    """The web site. Without JupyterLite the job says what to install."""
    project = copy_of(first_run[0].folder, tmp_path_factory.mktemp("lite"), PARTS + LEFT)
    made = project.run("lite", *ALONE)
    if importlib.util.find_spec("jupyterlite_pyodide_kernel") is None:
        assert made.returncode == 1
        assert "install -r workflow/envs/lite.txt" in " ".join(made.stdout.split())
        pytest.skip("JupyterLite is not installed: workflow/envs/lite.txt")
    assert made.returncode == 0, made.stdout
    if PYODIDE:
        (project / "results/lite/pyodide").symlink_to(PYODIDE)
    return project / "results/lite"


def test_the_site_has_the_notebooks_and_loads_their_packages_with_the_kernel(site):
    names = {path.name for path in (site / "files").iterdir()}
    assert {versions.WHEEL, "explorer.html"} < names
    for kind in ("student_", "after_"):
        assert len([name for name in names if name.startswith(kind)]) == 3
    assert not [name for name in names if "answers" in name]
    config = json.loads((site / "jupyter-lite.json").read_text())["jupyter-config-data"]
    (kernel,) = config["litePluginSettings"].values()
    loaded = kernel["loadPyodideOptions"]["packages"]
    assert loaded == [
        f"../../../../files/{versions.WHEEL}",
        "matplotlib",
        "numpy",
        "pandas",
        "scipy",
    ]
    assert kernel.get("pyodideUrl") == ("./pyodide/pyodide.mjs" if PYODIDE else None)
    assert sum(path.stat().st_size for path in site.rglob("*") if path.is_file()) < 30e6


@pytest.fixture
def address(site):
    """Where the site is served."""
    if not PYODIDE:
        try:
            socket.create_connection(("cdn.jsdelivr.net", 443), timeout=5).close()
        except OSError:
            pytest.skip("the network of Pyodide is not reached, and PYODIDE_FOLDER names no copy")
    handler = functools.partial(SimpleHTTPRequestHandler, directory=site)
    with ThreadingHTTPServer(("localhost", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://localhost:{server.server_port}"
        server.shutdown()


def test_the_first_cell_runs_in_the_browser(address):
    cell, prompt = ".jp-Notebook .jp-CodeCell", ".jp-InputPrompt:text-is('[1]:')"
    with browser.page() as tab:
        tab.open(f"{address}/notebooks/index.html?path=student_choosing_a_model.ipynb")
        tab.page.locator(f"{cell} .jp-InputArea").first.click(timeout=120_000)
        tab.press("Shift+Enter")
        tab.page.locator(prompt).wait_for(timeout=300_000)
        said = tab.page.locator(f"{cell} .jp-OutputArea-output").all_inner_texts()
        assert [text.strip() for text in said] == ["Exception reporting mode: Minimal"]
