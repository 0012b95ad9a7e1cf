"""An article of our own HTML as a PDF of two columns, as journals print them.

It knows the elements that the note uses. A PDF of the same article has the same bytes.
"""

from collections.abc import Mapping
from html import escape
from html.parser import HTMLParser
from typing import Any, NamedTuple, TypeAlias

from reportlab.lib.enums import TA_JUSTIFY
from reportlab.lib.pagesizes import A4
from reportlab.lib.styles import ParagraphStyle
from reportlab.lib.units import mm
from reportlab.pdfbase import pdfmetrics
from reportlab.pdfbase.ttfonts import TTFont
from reportlab.pdfgen.canvas import Canvas
from reportlab.platypus import (
    Flowable,
    Frame,
    Image,
    Paragraph,
    Table,
    TableStyle,
)

from stronge1994.figures.shared.drawing import house_style

FACES = {"": "STIXGeneral", "bold": "STIXGeneralBol", "italic": "STIXGeneralItalic"}
MARGIN, GAP = 17 * mm, 7 * mm
COLUMN, HEIGHT = (A4[0] - 2 * MARGIN - GAP) / 2, A4[1] - 2 * MARGIN
# Room below a heading for a few lines of text.
ROOM_BELOW_HEADING = 36.0
# Elements within a line, as ReportLab names them.
INLINE = {"i": "i", "b": "b", "sub": "sub", "sup": "super"}
# Distance of indices from their line, and their size, in points.
INDEX = {"sub": ' rise="2" size="6.5"', "sup": ' rise="3.5" size="6.5"'}
BLOCKS = ("h1", "h2", "h3", "p", "li", "th", "td", "figcaption", "caption")


def styles() -> dict[str, ParagraphStyle]:
    """How each block is set, by the name of its element or its class."""
    body = ParagraphStyle(
        "p", fontName="STIX", fontSize=9, leading=11, alignment=TA_JUSTIFY, spaceAfter=3
    )
    small = ParagraphStyle("small", body, fontSize=8, leading=9.6)
    cell = ParagraphStyle("td", small, alignment=0, spaceAfter=0)
    heading = {"alignment": 0, "keepWithNext": True}
    return {
        "p": body,
        "small": small,
        "li": ParagraphStyle("li", body, leftIndent=8, bulletIndent=0, spaceAfter=2),
        "h1": ParagraphStyle("h1", body, fontSize=17, leading=20, fontName="STIX-bold", **heading),
        "h2": ParagraphStyle(
            "h2", body, fontSize=11, leading=13, fontName="STIX-bold", spaceBefore=6, **heading
        ),
        "h3": ParagraphStyle("h3", body, fontName="STIX-italic", spaceBefore=3, **heading),
        "td": cell,
        "th": ParagraphStyle("th", cell, fontName="STIX-bold"),
        "figcaption": ParagraphStyle("figcaption", small, spaceAfter=6),
        "caption": ParagraphStyle("caption", small, spaceAfter=2, keepWithNext=True),
    }


class _Float(NamedTuple):
    """A picture or a table with its caption: they stay together."""

    parts: list[Flowable]


_Part: TypeAlias = Flowable | _Float


class _Article(HTMLParser):
    """Flowables of the element `article`; pictures by the name in their `data-figure`."""

    def __init__(self, pictures: Mapping[str, str]) -> None:
        super().__init__()
        self.pictures = pictures
        self.styles = styles()
        self.head: list[_Part] = []  # up to the end of the element `header`
        self.body: list[_Part] = []
        self._into: list[_Part] | None = None
        self._line: list[str] | None = None
        self._style = self.styles["p"]
        self._rows: list[list[Paragraph]] = []
        self._shares: list[float] = []  # of the column's width, in per cent
        self._kept: list[Flowable] = []  # a picture, or the heading of a table

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        values = dict(attributes)
        if tag == "article":
            self._into = self.body
        elif self._into is None:
            return
        elif tag == "header":
            self._into = self.head
        elif tag in BLOCKS:
            kind = "small" if tag == "p" and values.get("class") == "small" else tag
            self._line, self._style = [], self.styles[kind]
        elif tag == "table":
            self._shares = [float(share) for share in str(values["data-widths"]).split()]
        elif tag == "tr":
            self._rows.append([])
        elif tag == "img":
            self._kept.append(self._picture(str(values["data-figure"])))
        elif self._line is not None and tag in INLINE:
            self._line.append(f"<{INLINE[tag]}{INDEX.get(tag, '')}>")

    def handle_data(self, data: str) -> None:
        if self._line is not None:
            self._line.append(escape(data))

    def handle_endtag(self, tag: str) -> None:
        if self._into is None:
            return
        if tag == "header":
            self._into = self.body
        elif tag == "article":
            self._into = None
        elif tag in BLOCKS and self._line is not None:
            self._end_block(tag, " ".join("".join(self._line).split()))
            self._line = None
        elif tag == "table":
            table = Table(
                self._rows, colWidths=[COLUMN * share / 100 for share in self._shares], repeatRows=1
            )
            table.setStyle(RULES)
            self._into.append(_Float([*self._kept, table]))
            self._rows, self._kept = [], []
        elif tag in INLINE and self._line is not None:
            self._line.append(f"</{INLINE[tag]}>")

    def _end_block(self, tag: str, text: str) -> None:
        assert self._into is not None
        bullet = "•" if tag == "li" else None
        paragraph = Paragraph(text, self._style, bulletText=bullet)
        if tag in ("td", "th"):
            self._rows[-1].append(paragraph)
        elif tag == "caption":
            self._kept.append(paragraph)
        elif tag == "figcaption":
            self._into.append(_Float([*self._kept, paragraph]))
            self._kept = []
        else:
            self._into.append(paragraph)

    def _picture(self, name: str) -> Image:
        image = Image(self.pictures[name])
        image.drawHeight *= COLUMN / image.drawWidth
        image.drawWidth = COLUMN
        return image


RULES = TableStyle(
    [
        ("LINEABOVE", (0, 0), (-1, 0), 0.8, "black"),
        ("LINEBELOW", (0, 0), (-1, 0), 0.4, "black"),
        ("LINEBELOW", (0, -1), (-1, -1), 0.8, "black"),
        ("LEFTPADDING", (0, 0), (-1, -1), 1),
        ("RIGHTPADDING", (0, 0), (-1, -1), 2),
        ("TOPPADDING", (0, 0), (-1, -1), 0.5),
        ("BOTTOMPADDING", (0, 0), (-1, -1), 1.5),
        ("VALIGN", (0, 0), (-1, -1), "TOP"),
    ]
)


class _Pages:
    """Pages of two columns; text fills the place of a picture that moves to the next column."""

    def __init__(self, path: str, title: str, head: list[_Part]) -> None:
        # The same text gives the same bytes.
        self.canvas = Canvas(path, pagesize=A4, invariant=1)
        self.canvas.setTitle(title)
        self.page, self.columns = 1, [0.0]
        width = 2 * COLUMN + GAP
        # A frame that is exactly as high as its content may refuse it.
        top = _height(head, width) + 11.0
        _frame(MARGIN, HEIGHT - top, width, top).addFromList(list(head), self.canvas)
        self.columns = [MARGIN, MARGIN + COLUMN + GAP]
        self.below = top + GAP
        self.waiting: list[_Float] = []
        self.frame = self._column()

    def _column(self) -> Frame:
        return _frame(self.columns.pop(0), 0.0, COLUMN, HEIGHT - self.below)

    def _next(self) -> None:
        """Go to the next column, and put the waiting pictures on its top."""
        if not self.columns:
            self._end_page()
            self.canvas.showPage()
            self.page, self.below = self.page + 1, 0.0
            self.columns = [MARGIN, MARGIN + COLUMN + GAP]
        self.frame = self._column()
        waiting, self.waiting = self.waiting, []
        for part in waiting:
            self._float(part)

    def _float(self, part: _Float) -> None:
        """Put a picture here, or in the next column if it has no room."""
        high = _height(part.parts)
        if high > HEIGHT:
            raise ValueError(f"a picture is {high:.0f} points high: allowed are {HEIGHT:.0f}")
        if self.waiting or high > self._room():
            self.waiting.append(part)
        else:
            self.frame.addFromList(list(part.parts), self.canvas)

    def _room(self) -> float:
        return float(self.frame._y - self.frame._y1p)

    def add(self, part: _Part) -> None:
        """Put a part where there is room for it."""
        if isinstance(part, _Float):
            self._float(part)
            return
        if part.getKeepWithNext() and _height([part]) + ROOM_BELOW_HEADING > self._room():
            self._next()
        while not self.frame.add(part, self.canvas):
            pieces = self.frame.split(part, self.canvas)
            if len(pieces) < 2 and (high := _height([part])) > HEIGHT:
                raise ValueError(f"a line is {high:.0f} points high: allowed are {HEIGHT:.0f}")
            if len(pieces) > 1:
                self.frame.add(pieces[0], self.canvas)
                part = pieces[1]
            self._next()

    def end(self) -> int:
        """Put the waiting pictures, close the file, and return the number of pages."""
        while self.waiting:
            self._next()
        self._end_page()
        self.canvas.save()
        return self.page

    def _end_page(self) -> None:
        self.canvas.setFont("STIX", 8)
        self.canvas.drawCentredString(A4[0] / 2, MARGIN / 2, f"{self.page}")


def _height(parts: list[Any], width: float = COLUMN) -> float:
    return sum(
        part.wrap(width, HEIGHT)[1] + part.getSpaceBefore() + part.getSpaceAfter() for part in parts
    )


def _frame(left: float, bottom: float, width: float, height: float) -> Frame:
    bare = dict.fromkeys(("leftPadding", "rightPadding", "topPadding", "bottomPadding"), 0)
    return Frame(left, MARGIN + bottom, width, height, **bare)


def write(path: str, page: str, pictures: Mapping[str, str], title: str) -> int:
    """Write the element `article` of a page as a PDF without links; return the number of pages."""
    for kind, file in FACES.items():
        name = f"STIX-{kind}" if kind else "STIX"
        pdfmetrics.registerFont(TTFont(name, str(house_style.FONTS / f"{file}.ttf")))
    pdfmetrics.registerFontFamily(
        "STIX", normal="STIX", bold="STIX-bold", italic="STIX-italic", boldItalic="STIX-bold"
    )
    article = _Article(pictures)
    article.feed(page)
    pages = _Pages(path, title, article.head)
    for part in article.body:
        pages.add(part)
    return pages.end()
