"""What each package refuses, with a line for each fault: the tables of tests/refusals.

A folder there has the name of one in src, and a table that of a package in it. A call knows `np`,
`tmp_path`, what `planarimpact` exports, and the names that the `setup` of its table makes. `error`
names the type of what is raised, ValueError if it is not there, and `seconds` how long it may take
at most, of the processor, where too large a task is refused before it starts.
"""

import time
import tomllib
from pathlib import Path

import numpy as np
import pytest

import planarimpact

TABLES = Path(__file__).parents[1] / "refusals"


def rows():
    """Each row of each table: set-up, call, words of the message, type of the error, seconds."""
    for path in sorted(TABLES.glob("*/*.toml")):
        table = tomllib.loads(path.read_text(encoding="utf-8"))
        for row in table["refused"]:
            entry = row if isinstance(row, dict) else dict(zip(("call", "words"), row, strict=True))
            error = entry.get("error", table.get("error", "ValueError"))
            given = table.get("setup", ""), entry["call"], entry["words"], error
            seconds = table.get("seconds", np.inf)
            yield pytest.param(*given, seconds, id=f"{path.stem}: {entry['call']}")


@pytest.mark.parametrize(("setup", "call", "words", "error", "seconds"), list(rows()))
def test_bad_input_is_refused_in_words(setup, call, words, error, seconds, tmp_path):
    names = {name: getattr(planarimpact, name) for name in planarimpact.__all__}
    names |= {"np": np, "tmp_path": tmp_path}
    exec(setup, names)
    start = time.process_time()
    with pytest.raises(eval(error, names)) as refusal:
        eval(call, names)
    assert time.process_time() - start < seconds
    message = str(refusal.value)
    lines = message.splitlines()
    assert any(words in line for line in lines) and all(map(str.isascii, lines))
    assert len(lines) == 1 or error.endswith("SourceError")  # a file may have several faults
