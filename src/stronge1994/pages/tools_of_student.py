"""Tools of this notebook: %%after shows nothing before your prediction, stage shows a throw."""

import html
from pathlib import Path

from IPython import get_ipython
from IPython.display import display
from IPython.utils.capture import capture_output


def after(number: str, cell: str) -> None:
    """Run a cell, and show what it gives only if PREDICTION_number has words."""
    shell, name = get_ipython(), f"PREDICTION_{number.strip()}"
    # As in any cell, a semicolon at the end hides what the last line gives.
    cell += "\nNone" if cell.rstrip().endswith(";") else ""
    # An error of the cell becomes that of this magic, and is shown once.
    shell._showtraceback = lambda *_: None
    try:
        if str(shell.user_ns.get(name, "")).strip():
            result = shell.run_cell(cell)
        else:
            with capture_output() as kept:
                result = shell.run_cell(cell)
            if result.success:
                print(f"Write your prediction in {name} first, then run this cell again.")
            else:
                kept.show()
    finally:
        del shell._showtraceback
    result.raise_error()


def stage(throw: str, ask: bool = False) -> None:
    """Show a throw, whose settings are those of the explorer, and say its address."""
    settings = throw.replace("=", " ").replace("&", ", ")
    page, flags = Path("explorer.html"), "?stage&ask" if ask else "?stage"
    if not page.is_file():
        print(f"{settings}. To play it, put the file explorer.html beside this notebook.")
        return
    address, text = html.escape(f"{flags}#{throw}"), page.read_text(encoding="utf-8")
    text = text.replace("<html", f'<html data-address="{address}"', 1)
    frame = """<iframe title="A throw to play" style="width: 100%; height: 40rem; border: 0"
srcdoc="{}"></iframe>"""
    display({"text/html": frame.format(html.escape(text))}, raw=True)
    print(f"{settings}. Its address: explorer.html{flags if ask else ''}#{throw}")


if get_ipython():
    get_ipython().register_magic_function(after, "cell")
