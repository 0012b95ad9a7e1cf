"""The browser of these tests: they are skipped without it; it does not hang, and hides nothing."""

import os

import pytest

from tests.workflow import browser


def test_without_a_browser_tests_are_skipped(monkeypatch):
    monkeypatch.setattr(browser.shutil, "which", lambda name: None)
    with pytest.raises(pytest.skip.Exception, match="chromium"), browser.page():
        pass


def test_a_browser_that_hangs_is_given_up_and_killed():
    with pytest.raises(browser.Error, match="Timeout 500ms exceeded"), browser.page() as tab:
        protocol = tab.page.context.browser.new_browser_cdp_session()
        started = protocol.send("SystemInfo.getProcessInfo")["processInfo"]
        tab.timeout = 0.5
        tab.evaluate("(() => { for (;;); })()")
    assert len(started) > 1
    for process in started:
        with pytest.raises(ProcessLookupError):
            os.kill(process["id"], 0)


def test_problems_of_a_page_are_noticed():
    with browser.page() as tab:
        tab.open("data:text/html,<script>console.error('oh'); missing()</script>")
        assert any("oh" in words for words in tab.problems)
        assert any("missing is not defined" in words for words in tab.problems)
        with pytest.raises(browser.Error, match="lost"):
            tab.evaluate("(() => { throw new Error('lost'); })()")
