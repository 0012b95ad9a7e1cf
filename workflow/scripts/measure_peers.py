"""Measure error and time of LAMMPS and pooltool, beside ours in the same process."""

from stronge1994.run import record

notes: list[str] = []
with record.recorded(snakemake) as settings:
    from stronge1994 import csv_tables, one_thread  # noqa: F401  (one thread: before numpy)
    from stronge1994.figures.trade import measurement

    rows, notes = measurement.measure(**settings)
    csv_tables.write(snakemake.output.table, rows)
    print("\n".join(notes or ["both codes are installed"]))
print("".join(f"peers: {note}\n" for note in notes), end="", flush=True)
