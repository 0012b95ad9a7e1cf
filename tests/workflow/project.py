"""A copy of the project in a folder, in which Snakemake can be run."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

from stronge1994.run import record

ROOT = Path(__file__).parents[2]
PARTS = ["Snakefile", "profiles", "workflow", "src", "data", "figures/README.md", ".gitignore"]
PARTS += ["LICENSE", "CITATION.cff"]
LEFT = ["results", "figures", ".snakemake"]  # by a run
TIMEOUT = 3600  # s, of one run: against one that hangs, not against a busy machine


class Project:
    """A copy of the project in which snakemake can be run."""

    def __init__(self, folder):
        self.folder = folder

    def run(self, *arguments):
        """Run snakemake here; output and errors come back as one text in `stdout`."""
        return subprocess.run(
            [sys.executable, "-m", "snakemake", "--cores", "2", *arguments],
            cwd=self.folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=TIMEOUT,
        )

    def refuses_to_pass(self, *arguments):
        """Run, and check that nothing says PASSED; what was printed."""
        result = self.run(*arguments)
        assert result.returncode != 0, result.stdout
        assert "PASSED." not in result.stdout, result.stdout
        assert not (self / "results/PASSED").exists()
        return result.stdout

    def passes(self, *arguments):
        """Run, and check that all of it says PASSED; what was printed."""
        result = self.run(*arguments)
        assert result.returncode == 0 and "PASSED." in result.stdout, result.stdout
        assert (self / "results/PASSED").exists()
        return result.stdout

    def planned(self, *arguments):
        """Jobs that a run would do: `{message: reason}`, and how often each rule runs."""
        result = self.run("--dry-run", "--quiet", "host", *arguments)
        assert result.returncode == 0, result.stdout
        words = result.stdout
        jobs = dict(re.findall(r"^Job \d+: (.*)\nReason: (.*)$", words, flags=re.M))
        table = words.split("Job stats:")[-1].split("total")[0]
        return jobs, {rule: int(n) for rule, n in re.findall(r"^(\w+) +(\d+)$", table, flags=re.M)}

    def edit(self, path, old, new):
        """Replace a text that must be there."""
        file = self.folder / path
        text = file.read_text()
        assert old in text, (path, old)
        file.write_text(text.replace(old, new))

    def records(self):
        """What each job has read and written: `{job: record}`."""
        found = (self / record.FOLDER).glob("*.json")
        return {path.stem: record.read(str(path)) for path in found}

    def refuses(self, words, *arguments):
        """Check that a run is refused before any work, with these words (a pattern)."""
        result = self.run(*arguments)
        assert result.returncode != 0, result.stdout
        assert re.search(words, result.stdout), result.stdout
        assert "Traceback" not in result.stdout, result.stdout
        assert not (self / "results/logs").exists()

    def __truediv__(self, path):
        return self.folder / path


def copy_of(source, folder, parts=PARTS):
    """Copy the parts of a project that a run reads, or more."""
    for part in dict.fromkeys(parts):
        origin = source / part
        if origin.is_dir():
            # The pictures of the README are in the repository, and no run makes them.
            ignore = shutil.ignore_patterns("__pycache__", "*.egg-info", "preview*.png")
            shutil.copytree(origin, folder / part, ignore=ignore, dirs_exist_ok=True)
        elif origin.exists():
            (folder / part).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(origin, folder / part)
    return Project(folder)
