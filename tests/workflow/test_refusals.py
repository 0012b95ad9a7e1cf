"""Bad config, data and modules are refused before any work, in one line.

What a start of Snakemake checks is checked here in the process, and in tests/refusals; two whole
starts show that it does.
"""

import contextlib
import re

import numpy as np

from stronge1994.plan import config as configuration
from tests.workflow.project import ROOT, config, ledger, sources

README = (ROOT / "workflow/README.md").read_text(encoding="utf-8")
TROUBLE = README.split("## Troubleshooting")[1].split("\n## ")[0]


def test_a_bound_is_refused_before_it_says_nothing():
    """Of one comparison for each metric it is widened until it is refused. What a `range` may be
    depends on what it holds: see tests/unit/test_comparison.py.
    """

    def refused(name, key, new):
        alone = {"comparisons": {name: config()["comparisons"][name] | {key: new}}}
        with contextlib.chdir(ROOT):
            try:
                configuration.check_config(config() | alone, sources(), ledger())
            except configuration.ConfigError as error:
                assert f"{name}.{key}" in str(error) and "\n" not in str(error)
                return True
        return False

    tried = {(entry["metric"], *entry): name for name, entry in config()["comparisons"].items()}
    for name in tried.values():
        entry = config()["comparisons"][name]
        for part, (low, high) in entry.get("regression", {}).items():
            ends, far = np.array([low, high]), int(abs(high) > abs(low))
            while not refused(name, "regression", {part: ends.tolist()}):
                # A difference that doubles, from wherever it was within them, leaves them.
                assert np.abs(ends).max() < 2 * np.abs(ends).min()
                ends[far] *= 1.3
            for wide in ([low, 1e9], [-1e9, high], [0.0, abs(high)]):
                assert refused(name, "regression", {part: wide}), wide
        for part, size in entry.get("allowance", {}).items():
            for factor in (4, 1e9) if size else ():
                assert refused(name, "allowance", entry["allowance"] | {part: factor * size})
        for limit in (0.02, 3.0, 1e9):
            if "limit" in entry:
                assert refused(name, "limit", limit) == (entry["metric"] != "small" or limit > 2)


def explained(result):
    """The row of the README, under Troubleshooting, whose words a failed run has printed."""
    assert result.returncode != 0, result.stdout
    rows = re.findall(r"^\| `(.*?)`.*? \| (.*) \|$", TROUBLE, flags=re.M)
    assert len(rows) >= 5
    said = [advice for words, advice in rows if words in result.stdout]
    assert len(said) == 1, result.stdout
    return said[0]


# Whole starts, one for each place where it is refused.
STARTS = [
    (["--config", "stiffness_ratio=-1"], "stiffness_ratio: -1 is less than"),
    (["--config", "samples=0400"], "--config samples=0400: '0400' is no decimal number"),
    (["fgi6"], r"No rule to produce fgi6(.|\n)*Targets are\n  all, fig2, fig3, .*fig9,"),
]


def test_a_refused_start_does_nothing_and_has_not_passed(fresh):
    for arguments, words in STARTS:
        (fresh / "results").mkdir(exist_ok=True)
        (fresh / "results/PASSED").write_text("passed")
        result = fresh.run(*arguments)
        assert result.returncode != 0 and re.search(words, result.stdout), result.stdout
        assert "Traceback" not in result.stdout
        assert not (fresh / "results/logs").exists() and not (fresh / "results/PASSED").exists()


def test_errors_of_snakemake_itself_are_explained(fresh):
    unquoted = ["figures={fig6:", "{restitution:", "[0,", "0.9]}}"]
    assert "quotes" in explained(fresh.run("--config", *unquoted))
    (fresh / "Snakefile").unlink()
    assert "another folder" in explained(fresh.run())
