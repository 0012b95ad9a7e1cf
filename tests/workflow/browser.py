"""A browser without a screen, to test pages with: the installed Chromium, driven by Playwright.

Every wait has a limit.
"""

import contextlib
import json

from playwright.sync_api import Error, sync_playwright

from tests import programs

# For wait_for_function(): Playwright's own evaluate() waits for a page that hangs for ever.
EVALUATE = """async (expression) => {
  try { return [JSON.stringify(await (0, eval)(expression)) ?? "null", null]; }
  catch (error) { return [null, String(error.stack ?? error)]; }
}"""


class Page:
    """One page of a running browser; `problems` are its errors, in the order in which they came."""

    def __init__(self, page, timeout):
        self.page, self.timeout, self.problems = page, timeout, []
        self.prefer, self.press = page.emulate_media, page.keyboard.press
        self.screenshot = page.screenshot
        self._protocol = page.context.new_cdp_session(page)
        page.on("pageerror", lambda error: self.problems.append(str(error)))
        page.on("console", self._hear)
        page.on("request", self._ask)

    def call(self, method, **parameters):
        """Result of a command of the browser's protocol, for what Playwright does not do."""
        return self._protocol.send(method, parameters)

    def open(self, address):
        """Load an address and wait until that is done."""
        self.page.goto(address, timeout=1000 * self.timeout)

    def evaluate(self, expression):
        """Value of a JavaScript expression, promises awaited; its exception is an `Error`."""
        limit = 1000 * self.timeout
        handle = self.page.wait_for_function(EVALUATE, arg=expression, timeout=limit)
        value, problem = handle.json_value()
        if problem is not None:
            raise Error(problem)
        return json.loads(value)

    def resize(self, width, height, mobile=False):
        """Size of the window in CSS pixels."""
        size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": mobile}
        self.call("Emulation.setDeviceMetricsOverride", **size)

    def _hear(self, message):
        if message.type in ("error", "warning", "assert"):
            self.problems.append(message.text)

    def _ask(self, request):
        if not request.url.startswith(("file:", "data:", "about:", "blob:")):
            self.problems.append(f"asks for {request.url}")


@contextlib.contextmanager
def page(timeout=20.0):
    """A page of a new browser, killed at the end whatever happens; one at a time in a process.

    `timeout` is the longest wait for an answer, in seconds.
    """
    program = programs.needed("pages in a browser")
    with sync_playwright() as driver:
        chromium = driver.chromium.launch(executable_path=program)
        try:
            yield Page(chromium.new_page(no_viewport=True), timeout)
        finally:
            chromium.close()
