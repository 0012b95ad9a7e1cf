"""Solve the curves of one figure. A crash becomes a table that says so: a failed verdict."""

import importlib
import traceback

import tables


def solve(figure, settings, output, node_files=(), node_column=None):
    """Write the curves of `figure`; reference tables give points that curves must pass through."""
    try:
        if node_files:
            settings = {**settings, "nodes": _nodes(node_files, node_column)}
        named = importlib.import_module(f"planarimpact.curves.{figure}").curves(**settings)
    except Exception as error:
        traceback.print_exc()
        tables.write_rows(output, ["error"], [[f"{type(error).__name__}: {error}"]])
        return
    tables.write(output, named)
