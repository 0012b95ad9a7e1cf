"""Scripts of pages without a browser: run by the node that comes with Playwright."""

import contextlib
import json
import subprocess
from pathlib import Path

from playwright._impl._driver import compute_driver_executable

FOLDER = Path(__file__).parents[2] / "workflow/explorer"
# Those that do not look at their page as they are loaded.
SCRIPTS = [
    "solver",
    "check",
    "models",
    "flight",
    "charts",
    "arrows",
    "words",
    "files",
    "lens",
    "stage",
]
# What is drawn is kept in elements that nobody sees, by their ids.
BASE = """
const drawn = {};
const document = { getElementById: (id) => drawn[id] ??= {
  style: {}, clientWidth: 640, clientHeight: 360, getComputedTextLength: () => 60,
  classList: { toggle: (name, on) => (document.getElementById(id)[`class ${name}`] = !!on) },
  setAttribute(name, value) { this[name] = value; },
} };
"""
# Answers each line, an expression, with its value or its error.
PROGRAM = """
const vm = require("node:vm");

require("node:readline").createInterface({ input: process.stdin }).on("line", (line) => {
  let answer;
  try {
    const value = vm.runInThisContext(JSON.parse(line), { timeout: 60000 });
    answer = [JSON.stringify(value) ?? "null", null];
  } catch (error) {
    answer = [null, String(error.stack ?? error)];
  }
  console.log(JSON.stringify(answer));
});
"""


class Scripts:
    """The scripts in a running process."""

    def __init__(self, process, texts):
        self._process = process
        self.evaluate("\n".join([*texts, "null"]))

    def evaluate(self, expression):
        """Value of a JavaScript expression; what it throws, or a minute without an end, raises."""
        self._process.stdin.write(json.dumps(expression) + "\n")
        self._process.stdin.flush()
        value, problem = json.loads(self._process.stdout.readline())
        if problem is not None:
            raise RuntimeError(problem)
        return json.loads(value)

    def map(self, function, rows):
        """Values of a JavaScript function for many arguments."""
        return self.evaluate(f"{json.dumps(rows)}.map({function})")


def explorer():
    """Texts of the scripts of the explorer."""
    return [BASE, *((FOLDER / f"{name}.js").read_text(encoding="utf-8") for name in SCRIPTS)]


@contextlib.contextmanager
def scripts(texts):
    """Scripts with these texts, loaded anew."""
    node, _ = compute_driver_executable()
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    with subprocess.Popen([node, "-e", PROGRAM], text=True, encoding="utf-8", **pipes) as process:
        yield Scripts(process, texts)
