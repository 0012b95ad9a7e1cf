"""A page of a run as its parts."""

import re
from html.parser import HTMLParser

VOID = {"meta", "img", "br", "input", "link", "hr"}


class Page(HTMLParser):
    """Anchors, links, resources, words, controls and the bar of all pages.

    With `strict` it refuses tags that do not balance, headings that skip a level and pictures
    without words.
    """

    def __init__(self, text, strict=False):
        super().__init__()
        self.ids, self.links, self.resources, self.words = [], [], [], []
        self.bar, self.controls, self.tags = [], {}, {}
        self._open, self._level, self._strict = [], 0, strict
        self._in_bar, self._select = False, None
        self.feed(text)
        assert not (strict and self._open), self._open

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        if "id" in found:
            self.ids.append(found["id"])
            self.tags[found["id"]] = tag
        self._in_bar |= tag == "nav" and found.get("class") == "site"
        if tag == "a" and "href" in found:
            self.links.append(found["href"])
            self.bar += [found["href"]] * self._in_bar
        self.resources += [found[key] for key in ("src", "srcset", "data") if found.get(key)]
        self.resources += [found["href"]] if tag == "link" else []
        if tag in ("input", "select"):
            self._select = self.controls[found.get("id", "")] = {**found, "options": []}
        elif tag == "option":
            self._select["options"].append(found.get("value"))
        if tag not in VOID:
            self._open.append(tag)
        if self._strict:
            self._refuse_faults(tag, found)

    def _refuse_faults(self, tag, found):
        if tag == "img":
            assert len(found["alt"]) > 10
            assert found["alt"].count("(") == found["alt"].count(")"), found["alt"]
        if re.fullmatch("h[1-6]", tag):
            assert int(tag[1]) <= self._level + 1, self.getpos()
            self._level = int(tag[1])

    def handle_endtag(self, tag):
        self._in_bar &= tag != "nav"
        opened = self._open.pop() if self._open else ""
        assert not self._strict or opened == tag, (tag, self.getpos())

    def handle_data(self, data):
        self.words.append(data)

    @property
    def text(self):
        """All words, with single spaces."""
        return " ".join(" ".join(self.words).split())
