"""Draw one figure from its curves: SVG and PNG. Curves that failed become a picture saying so."""

import importlib

import csv_tables
import drawing
import job
import reference_data


def draw(figure, settings, overlays, curves_path, series_paths, svg, png):
    """Draw `figure`; `overlays` are its reference series at hand, and facts, by name."""
    try:
        curves = csv_tables.read(curves_path)
    except csv_tables.Failed as error:
        drawing.save(drawing.failure(f"{figure}: the solver failed: {error}"), svg, png)
        return
    points = {
        name: _points(name, entry, series_paths[name.split("/")[0]]) if "kind" in entry else entry
        for name, entry in overlays.items()
    }
    module = importlib.import_module(f"draw_{figure}")
    drawing.save(module.draw(curves, settings, points), svg, png)


def _points(name, entry, path):
    columns = csv_tables.read(path)[name.split("/")[1]]
    return {
        "x": columns[reference_data.column_name(entry["x"])],
        "y": columns[reference_data.column_name(entry["y"])],
        "sigma": (entry["x"]["sigma"], entry["y"]["sigma"]),
        "line": entry.get("line", False),
        "columns": columns,
        "parameters": entry["parameters"],
    }


if "snakemake" in globals():
    with job.recorded(snakemake):  # noqa: F821
        draw(
            snakemake.wildcards.figure,  # noqa: F821
            snakemake.params.settings,  # noqa: F821
            snakemake.params.overlays,  # noqa: F821
            snakemake.input.curves,  # noqa: F821
            dict(zip(snakemake.params.sources, snakemake.input.series, strict=True)),  # noqa: F821
            snakemake.output.svg,  # noqa: F821
            snakemake.output.png,  # noqa: F821
        )
