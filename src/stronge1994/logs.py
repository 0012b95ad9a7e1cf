"""The log of a job."""

import sys


def to(path: str) -> None:
    """Send what this process prints, its errors too, to a file."""
    sys.stdout = sys.stderr = open(path, "w", encoding="utf-8")  # noqa: SIM115  (until it ends)
