"""Docstrings in numpydoc's form as HTML."""

import re
from textwrap import dedent

from markupsafe import Markup, escape

SECTION = re.compile(r"^([A-Z][A-Za-z ]+)\n-{3,}$", flags=re.M)
NAMED = ("Parameters", "Attributes")
FIELDS = (*NAMED, "Returns", "Yields", "Raises")


def html(docstring, link):
    """A docstring as HTML.

    Parameters
    ----------
    docstring : str
        Dedented, as `ast.get_docstring` gives it.
    link : callable
        Anchor of a name in backticks, or None.

    Returns
    -------
    Markup

    Examples
    --------
    >>> print(html("Sum.\\n\\nParameters\\n----------\\nx : float\\n    In m.", lambda name: None))
    <p>Sum.</p><h5>Parameters</h5><dl><dt><code>x</code> : float</dt><dd><p>In m.</p></dd></dl>
    """
    head, *rest = SECTION.split(docstring)
    parts = [_blocks(head, link)]
    for title, body in zip(rest[::2], rest[1::2], strict=True):
        content = _fields(body, link, title) if title in FIELDS else _blocks(body, link)
        parts.append(Markup("<h5>{}</h5>{}").format(title, content))
    return Markup("").join(parts)


def _fields(body, link, title):
    """Entries `name : type` with their descriptions, indented below."""
    # An argument is no function, though it may bear the name of one.
    to_type = (lambda name: None) if title in NAMED else link
    entries = re.split(r"^(?=\S)", body.strip("\n"), flags=re.M)[1:]
    parts = []
    for entry in entries:
        head, _, description = entry.partition("\n")
        name, colon, kind = head.partition(" : ")
        if colon:
            term = Markup("<code>{}</code> : {}").format(name, _inline(kind, link))
        elif all(word.lstrip("*").isidentifier() for word in head.split(", ")):
            term = _inline(f"`{head.replace(', ', '`, `')}`", to_type)
        else:
            term = _inline(head, link)
        words = _blocks(dedent(description), link)
        parts.append(Markup("<dt>{}</dt>").format(term))
        parts.append(Markup("<dd>{}</dd>").format(words) if words else "")
    return Markup("<dl>{}</dl>").format(Markup("").join(parts))


def _blocks(text, link):
    """Paragraphs, lists, tables and what must keep its lines: examples, indented text."""
    parts = []
    for block in re.split(r"\n\s*\n", text.strip("\n")):
        if not block.strip():
            continue
        if block.startswith((">>>", " ")):
            parts.append(Markup("<pre>{}</pre>").format(dedent(block)))
        elif block.startswith("- "):
            items = (_inline(item, link) for item in re.split(r"^- ", block, flags=re.M)[1:])
            parts.append(Markup("<ul>{}</ul>").format(Markup("").join(map(_item, items))))
        elif block.startswith("==="):
            parts.append(_table(block, link))
        else:
            parts.append(Markup("<p>{}</p>").format(_inline(block, link)))
    return Markup("").join(parts)


def _item(words):
    return Markup("<li>{}</li>").format(words)


def _table(block, link):
    """Two columns between rules of `=`, the first as wide as the first run of them."""
    rule, *rows, _ = block.split("\n")
    width = rule.index(" ")
    cells = ((_inline(row[:width], link), _inline(row[width:], link)) for row in rows)
    lines = [Markup('<tr><th scope="row">{}</th><td>{}</td></tr>').format(*row) for row in cells]
    table = Markup('<div class="scroll" tabindex="0"><table>{}</table></div>')
    return table.format(Markup("").join(lines))


def _inline(text, link):
    """A run of text; names in backticks become links where there is something to link to."""
    parts = re.split(r"`+([^`]+)`+", " ".join(text.split()))
    for index in range(1, len(parts), 2):
        code = Markup("<code>{}</code>").format(parts[index])
        anchor = link(parts[index])
        parts[index] = Markup('<a href="#{}">{}</a>').format(anchor, code) if anchor else code
    return Markup("").join(map(escape, parts))
