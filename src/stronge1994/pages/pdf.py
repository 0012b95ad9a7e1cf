"""An article of our own HTML as a PDF of two columns, as journals print them.

It knows the elements that the note uses. A PDF of the same article has the same bytes.
"""

from collections.abc import Mapping
from html import escape
from html.parser import HTMLParser
from typing import Any

from reportlab.lib.enums import TA_JUSTIFY
from reportlab.lib.pagesizes import A4
from reportlab.lib.styles import ParagraphStyle
from reportlab.lib.units import mm
from reportlab.pdfbase import pdfmetrics
from reportlab.pdfbase.ttfonts import TTFont
from reportlab.platypus import (
    BaseDocTemplate,
    Flowable,
    Frame,
    Image,
    KeepTogether,
    NextPageTemplate,
    PageTemplate,
    Paragraph,
    Table,
    TableStyle,
)

from stronge1994.figures.shared.drawing import house_style

FACES = {"": "STIXGeneral", "bold": "STIXGeneralBol", "italic": "STIXGeneralItalic"}
MARGIN, GAP = 17 * mm, 7 * mm
COLUMN = (A4[0] - 2 * MARGIN - GAP) / 2
# Elements within a line, as ReportLab names them.
INLINE = {"i": "i", "b": "b", "sub": "sub", "sup": "super"}
# How far indices stand off their line, and how small they are, in points.
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


class _Article(HTMLParser):
    """Flowables of the element `article`; pictures by the name in their `data-figure`."""

    def __init__(self, pictures: Mapping[str, str]) -> None:
        super().__init__()
        self.pictures = pictures
        self.styles = styles()
        self.head: list[Flowable] = []  # up to the end of the element `header`
        self.body: list[Flowable] = []
        self._into: list[Flowable] | None = None
        self._line: list[str] | None = None
        self._style = self.styles["p"]
        self._rows: list[list[Paragraph]] = []
        self._shares: list[float] = []  # of the column's width, in per cent
        self._kept: list[Flowable] = []  # a picture, or the heading of a table

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        given = dict(attributes)
        if tag == "article":
            self._into = self.body
        elif self._into is None:
            return
        elif tag == "header":
            self._into = self.head
        elif tag in BLOCKS:
            kind = "small" if tag == "p" and given.get("class") == "small" else tag
            self._line, self._style = [], self.styles[kind]
        elif tag == "table":
            self._shares = [float(share) for share in str(given["data-widths"]).split()]
        elif tag == "tr":
            self._rows.append([])
        elif tag == "img":
            self._kept.append(self._picture(str(given["data-figure"])))
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
            self._into.append(KeepTogether([*self._kept, table]))
            self._rows, self._kept = [], []
        elif tag in INLINE and self._line is not None:
            self._line.append(f"</{INLINE[tag]}>")

    def _end_block(self, tag: str, words: str) -> None:
        assert self._into is not None
        bullet = "•" if tag == "li" else None
        paragraph = Paragraph(words, self._style, bulletText=bullet)
        if tag in ("td", "th"):
            self._rows[-1].append(paragraph)
        elif tag == "caption":
            self._kept.append(paragraph)
        elif tag == "figcaption":
            self._into.append(KeepTogether([*self._kept, paragraph]))
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


def write(path: str, page: str, pictures: Mapping[str, str], title: str) -> int:
    """Write the element `article` of a page as a PDF, and return the number of its pages.

    `pictures` are PNG files by their names. Links lead to pages that a PDF does not have beside it,
    so their words alone are set.
    """
    for kind, file in FACES.items():
        name = f"STIX-{kind}" if kind else "STIX"
        pdfmetrics.registerFont(TTFont(name, str(house_style.FONTS / f"{file}.ttf")))
    pdfmetrics.registerFontFamily(
        "STIX", normal="STIX", bold="STIX-bold", italic="STIX-italic", boldItalic="STIX-bold"
    )
    article = _Article(pictures)
    article.feed(page)
    top = _height(article.head)
    bare: dict[str, Any] = dict.fromkeys(
        ("leftPadding", "rightPadding", "topPadding", "bottomPadding"), 0
    )
    height = A4[1] - 2 * MARGIN

    def columns(below: float) -> list[Frame]:
        left = MARGIN, MARGIN + COLUMN + GAP
        return [Frame(x, MARGIN, COLUMN, height - below, **bare) for x in left]

    head = Frame(MARGIN, A4[1] - MARGIN - top, 2 * COLUMN + GAP, top, **bare)
    document = BaseDocTemplate(path, pagesize=A4, title=title, invariant=1)
    document.addPageTemplates(
        [
            PageTemplate("first", [head, *columns(top + GAP)], onPage=_number),
            PageTemplate("later", columns(0.0), onPage=_number),
        ]
    )
    document.build([NextPageTemplate("later"), *article.head, *article.body])
    return int(document.page)


def _height(parts: list[Flowable]) -> float:
    """Height of what stands over both columns."""
    width = 2 * COLUMN + GAP
    # One line of room: a frame that is exactly as high as its content may refuse it.
    return sum(part.wrap(width, A4[1])[1] + part.getSpaceAfter() for part in parts) + 11.0


def _number(canvas: Any, document: Any) -> None:
    canvas.setFont("STIX", 8)
    canvas.drawCentredString(A4[0] / 2, MARGIN / 2, f"{document.page}")
