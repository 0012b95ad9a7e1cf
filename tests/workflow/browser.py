"""A browser without a screen, to test pages with: Chromium, driven over a pipe.

Messages are JSON, ended by a NUL, on file descriptors 3 and 4 of the browser (the DevTools
protocol of --remote-debugging-pipe): no port, no other package. Every wait has a limit.
"""

import base64
import contextlib
import json
import os
import select
import shutil
import signal
import subprocess
import tempfile
import time

import pytest

NAMES = ("chromium", "chromium-browser", "google-chrome")
FLAGS = (
    "--headless=new",
    "--remote-debugging-pipe",
    "--no-first-run",
    "--no-default-browser-check",
    "--disable-gpu",
    "--disable-dev-shm-usage",
    "--disable-extensions",
    "--disable-background-networking",
    "--hide-scrollbars",
)
KEYS = {  # code, Windows' key code, text
    "Tab": ("Tab", 9, ""),
    " ": ("Space", 32, " "),
    "Enter": ("Enter", 13, "\r"),
    "ArrowLeft": ("ArrowLeft", 37, ""),
    "ArrowRight": ("ArrowRight", 39, ""),
}


class BrowserError(Exception):
    """The browser did not answer in time, has gone, or refused."""


class Page:
    """One page of a running browser; `problems` are its errors, in the order in which they came."""

    def __init__(self, to_browser, from_browser, timeout):
        self._to, self._from, self.timeout = to_browser, from_browser, timeout
        self._unread, self._count, self._session = b"", 0, None
        self._events = []
        self.problems = []

    def attach(self):
        """Take a tab, and listen to what goes wrong in it."""
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        attached = self.call("Target.attachToTarget", targetId=target, flatten=True)
        self._session = attached["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")

    def call(self, method, **parameters):
        """Result of a command of the protocol."""
        self._count += 1
        message = {"id": self._count, "method": method, "params": parameters}
        if self._session:
            message["sessionId"] = self._session
        self._write(json.dumps(message).encode() + b"\0")
        deadline = time.monotonic() + self.timeout
        while True:
            answer = self._read(deadline, method)
            if answer.get("id") == self._count:
                if "error" in answer:
                    raise BrowserError(f"{method}: {answer['error']['message']}")
                return answer["result"]
            self._note(answer)

    def open(self, address):
        """Load an address and wait until that is done."""
        self._events.clear()
        self.call("Page.navigate", url=str(address))
        deadline = time.monotonic() + self.timeout
        while "Page.loadEventFired" not in self._events:
            self._note(self._read(deadline, f"opening {address}"))

    def evaluate(self, expression):
        """Value of a JavaScript expression, promises awaited; its exception is a BrowserError."""
        options = {"returnByValue": True, "awaitPromise": True}
        answer = self.call("Runtime.evaluate", expression=expression, **options)
        if "exceptionDetails" in answer:
            raise BrowserError(_words(answer["exceptionDetails"]))
        return answer["result"].get("value")

    def press(self, key, shift=False):
        """Press and release a key of `KEYS`."""
        code, number, text = KEYS[key]
        what = {"key": key, "code": code, "windowsVirtualKeyCode": number}
        what["modifiers"] = 8 if shift else 0
        down = {"type": "keyDown", "text": text} if text else {"type": "rawKeyDown"}
        self.call("Input.dispatchKeyEvent", **down, **what)
        self.call("Input.dispatchKeyEvent", type="keyUp", **what)

    def resize(self, width, height, mobile=False):
        """Size of the window in CSS pixels."""
        size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": mobile}
        self.call("Emulation.setDeviceMetricsOverride", **size)

    def prefer(self, **features):
        """Preferences of the reader: prefer(prefers_reduced_motion="reduce")."""
        chosen = [{"name": n.replace("_", "-"), "value": v} for n, v in features.items()]
        self.call("Emulation.setEmulatedMedia", features=chosen)

    def screenshot(self, whole=False):
        """The page as PNG: what the window shows, or all of it."""
        answer = self.call("Page.captureScreenshot", captureBeyondViewport=whole)
        return base64.b64decode(answer["data"])

    def _write(self, text):
        while text:
            if not select.select([], [self._to], [], self.timeout)[1]:
                raise BrowserError("the browser takes no more messages")
            text = text[os.write(self._to, text[:65536]) :]

    def _read(self, deadline, what):
        while b"\0" not in self._unread:
            left = deadline - time.monotonic()
            if left <= 0 or not select.select([self._from], [], [], left)[0]:
                raise BrowserError(f"{what}: no answer within {self.timeout:g} s")
            piece = os.read(self._from, 1 << 20)
            if not piece:
                raise BrowserError(f"{what}: the browser has gone")
            self._unread += piece
        message, self._unread = self._unread.split(b"\0", 1)
        return json.loads(message)

    def _note(self, message):
        name, what = message.get("method"), message.get("params", {})
        self._events.append(name)
        if name == "Runtime.exceptionThrown":
            self.problems.append(_words(what["exceptionDetails"]))
        elif name == "Runtime.consoleAPICalled" and what["type"] in ("error", "warning", "assert"):
            said = [str(a.get("value", a.get("description"))) for a in what["args"]]
            self.problems.append(" ".join(said))
        elif name == "Log.entryAdded" and what["entry"]["level"] in ("error", "warning"):
            self.problems.append(what["entry"]["text"])
        elif name == "Network.requestWillBeSent":
            address = what["request"]["url"]
            if not address.startswith(("file:", "data:", "about:")):
                self.problems.append(f"asks for {address}")


def _words(details):
    return details.get("exception", {}).get("description") or details["text"]


def find():
    """Path of an installed browser, or None."""
    return next(filter(None, map(shutil.which, NAMES)), None)


@contextlib.contextmanager
def page(timeout=20.0):
    """A page of a new browser with a profile of its own, killed at the end whatever happens.

    Parameters
    ----------
    timeout : float
        Longest wait for an answer, in seconds.
    """
    program = find()
    if program is None:
        pytest.skip(f"no browser to test the page with: none of {', '.join(NAMES)} is installed")
    flags = [*FLAGS, *(["--no-sandbox"] if os.geteuid() == 0 else [])]
    browser_reads, to_browser = os.pipe()
    from_browser, browser_writes = os.pipe()
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        # The shell puts the two ends where the browser expects them.
        command = f'exec "$@" 3<&{browser_reads} 4>&{browser_writes}'
        process = subprocess.Popen(
            ["bash", "-c", command, "bash", program, *flags, f"--user-data-dir={profile}"],
            pass_fds=(browser_reads, browser_writes),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        os.close(browser_reads)
        os.close(browser_writes)
        try:
            found = Page(to_browser, from_browser, timeout)
            found.attach()
            yield found
        finally:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait(timeout=10)
            os.close(to_browser)
            os.close(from_browser)
