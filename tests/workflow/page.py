"""A page of a run as its parts."""

import re
from html.parser import HTMLParser

WITHOUT_SENTENCES = re.compile(r"<(script|style|code|pre|svg)\b.*?</\1>", flags=re.S)
IN_A_SENTENCE = re.compile(r"</?(?:a|abbr|b|em|i|math|m[inor]\w*|span|strong|su[bp])\b[^>]*>")


def seen(text):
    """Words of a piece of HTML with the white space that a reader sees between them."""
    return re.sub(r"<[^>]+>", " ", IN_A_SENTENCE.sub("", WITHOUT_SENTENCES.sub(" ", text)))


def flat(text):
    """Words of a piece of HTML, without white space."""
    return "".join("".join(Page(text).words).split())


class Page(HTMLParser):
    """Anchors, links, resources, words, controls and the bar of all pages."""

    def __init__(self, text):
        super().__init__()
        self.ids, self.links, self.resources, self.words = [], [], [], []
        self.bar, self.controls = [], {}
        self._in_bar, self._select = False, None
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        if "id" in found:
            self.ids.append(found["id"])
        self._in_bar |= tag == "nav" and found.get("class") == "site"
        if tag in ("a", "use") and "href" in found:
            self.links.append(found["href"])
            self.bar += [found["href"]] * self._in_bar
        self.resources += [found[key] for key in ("src", "srcset", "data") if found.get(key)]
        self.resources += [found["href"]] if tag in ("link", "image") and "href" in found else []
        if tag in ("input", "select"):
            self._select = self.controls[found.get("id", "")] = {**found, "options": []}
        elif tag == "option":
            self._select["options"].append(found.get("value"))

    def handle_endtag(self, tag):
        self._in_bar &= tag != "nav"

    def handle_data(self, data):
        self.words.append(data)

    @property
    def text(self):
        """All words, with single spaces."""
        return " ".join(" ".join(self.words).split())
