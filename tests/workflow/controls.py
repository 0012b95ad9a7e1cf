"""What a reader does with the explorer and sees there, for its tests."""

import json
import re
import time

import numpy as np

# A change is drawn in the next frame of the browser.
FRAME = "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
SOLID = "&poisson_ratio=0.3&mass_ratio=3.5"


def element(name):
    return f"document.getElementById('{name}')"


def text(tab, name):
    return tab.evaluate(f"{element(name)}.textContent.trim()")


def texts(tab, query):
    return tab.evaluate(f"[...document.querySelectorAll('{query}')].map((e) => e.textContent)")


def number(words):
    return float(words.replace("\u2212", "-"))


def value(tab, name):
    return float(tab.evaluate(f"{element(name)}.value"))


def type_in(tab, name, typed):
    """Type into a box, or choose in a list or of a slider."""
    tab.evaluate(
        f"{{ const box = {element(name)}; box.value = '{typed}';"
        " for (const kind of ['input', 'change']) box.dispatchEvent(new Event(kind)); }"
    )
    tab.evaluate(FRAME)


def click(tab, name):
    tab.evaluate(f"{element(name)}.click()")
    tab.evaluate(FRAME)


def wait_for(tab, expression, wanted):
    """Wait until a JavaScript expression has a value; for what the page does a little later."""
    deadline = time.monotonic() + 5
    while tab.evaluate(expression) != wanted and time.monotonic() < deadline:
        time.sleep(0.02)
    assert tab.evaluate(expression) == wanted


def middle(tab, name):
    """The middle of an element on the screen."""
    box = f"{element(name)}.getBoundingClientRect()"
    return tab.evaluate(f"(({{x, y, width, height}}) => [x + width / 2, y + height / 2])({box})")


def at_times(tab, times, expression):
    """Value of a JavaScript expression at times t/t_c of the first bounce."""
    return tab.evaluate(
        f"(() => {{ const slider = {element('time')}, {{ segment }} = stage.first_bounce(0),"
        " part = (name) => document.getElementById(`diagram-${name}`);"
        f" return {json.dumps(list(times))}.map((t) => {{"
        " slider.value = segment.start + (t / segment.end) * segment.length;"
        f" slider.dispatchEvent(new Event('input')); return {expression}; }}); }})()"
    )


def numbers_of(words):
    return [float(one) for one in re.findall(r"-?[\d.]+", words)]


def shown_energies(tab):
    """Percents in the table of energies, a row for each kind: before, now and after."""
    rows = "[...document.querySelectorAll('#energies tbody tr')]"
    cells = tab.evaluate(f"{rows}.map((r) => [...r.cells].slice(1).map((c) => c.textContent))")
    return np.array([[0.0 if cell == "\u2013" else float(cell) for cell in row] for row in cells])
