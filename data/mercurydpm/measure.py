"""Rebounds in MercuryDPM with the lines that `planarimpact.fit` writes, and with usual values.

    python data/mercurydpm/measure.py KERNEL LIBRARY

KERNEL is the folder Kernel of MercuryDPM's source, LIBRARY the folder where it was built. What is
measured is that of data/yade.
"""

import json
import runpy
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
CASE = """case {number}: {{
{lines}
ofSpheres = species, ofWalls = wall;
}} break;"""
LIBRARIES = "libMercuryBase.a", "Math/libLinearAlgebra.a"


def in_mercurydpm(impacts: list[dict[str, Any]]) -> list[list[float]]:
    """What MercuryDPM answers to impacts: one program with the lines of all of them."""
    kernel, library = map(Path, sys.argv[1:])
    cases = [CASE.format(number=n, lines=one["lines"]) for n, one in enumerate(impacts)]
    text = (HERE / "impacts.cc").read_text(encoding="utf-8")
    text = text.replace("CASES", "\n".join(["switch (number) {", *cases, "}"]), 1)
    asked = [
        f"{one['radius']!r} {one['friction']!r} {one['speed']!r} {one['begins']!r} "
        f"{int(one['wall'])} {len(one['incidence'])} {' '.join(map(repr, one['incidence']))}\n"
        for one in impacts
    ]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "impacts.cc").write_text(text, encoding="utf-8")
        (folder / "asked").write_text("".join(asked), encoding="utf-8")
        command = ["g++", "-std=c++17", "-O1", "-w", f"-I{kernel}", f"-I{library}", "impacts.cc"]
        command += [*(str(library / one) for one in LIBRARIES), "-lgfortran"]
        subprocess.run(command, cwd=folder, check=True)
        subprocess.run(["./a.out"], cwd=folder, check=True, capture_output=True)
        answers = (folder / "answers").read_text(encoding="utf-8").splitlines()
    return [json.loads(f"[{line.replace(' ', ',')}]") for line in answers]


if __name__ == "__main__":
    yade = runpy.run_path(str(HERE.parent / "yade/measure.py"))
    yade["write"](HERE, "mercurydpm", in_mercurydpm)
