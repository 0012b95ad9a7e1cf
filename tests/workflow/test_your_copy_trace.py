"""The page `your_copy.html` follows lines in made-up prints, drawn here pixel by pixel."""

import base64
import io

import numpy as np
import pytest
from PIL import Image

from tests.workflow.project import ROOT

SCRIPTS = [ROOT / f"workflow/your_copy/{name}.js" for name in ("colours", "trace")]
SIZE = WIDTH, HEIGHT = 780, 400  # pixels
FOLLOW = """async ([address, clicks]) => {
  const picture = new Image();
  picture.src = address;
  await picture.decode();
  return trace.follow(colours_of(picture), clicks); }"""
U, V = np.meshgrid(np.arange(WIDTH) + 0.5, np.arange(HEIGHT) + 0.5)  # middles of pixels


def curve(u):
    """Height of the line in pixels, for places along x."""
    return 200 + 120 * np.sin(u / 130)


def slope(u):
    return 120 / 130 * np.cos(u / 130)


def stroke(off, width):
    """How much of each pixel a stroke covers, by the distance from its middle."""
    return np.clip(width / 2 - np.abs(off) + 0.5, 0, 1)


def cover(width=3.3, u=U, v=V):
    return stroke((v - curve(u)) / np.hypot(1, slope(u)), width)


def painted(paper, *layers):
    """A picture as RGB: each layer is how much it covers, and its colour."""
    picture = np.broadcast_to(np.asarray(paper, float), (*U.shape, 3))
    for covered, colour in layers:
        picture = picture + covered[..., None] * (np.asarray(colour, float) - picture)
    return picture


@pytest.fixture
def followed(tab):
    """What the page finds from clicks at these x, half a pixel off the line, the last one more."""
    tab.problems.clear()
    tab.open("about:blank")
    for script in SCRIPTS:
        tab.page.add_script_tag(content=script.read_text(encoding="utf-8"))

    def follow(picture, at=(20, 200, 400, 600, 760), last=0.0):
        noise = np.random.default_rng(0).normal(0, 5, U.shape)
        noisy = np.clip(picture + noise[..., None], 0, 255).astype(np.uint8)
        file = io.BytesIO()
        # With four channels it may be transparent, which JPEG cannot store.
        Image.fromarray(noisy).save(file, "png" if picture.shape[-1] == 4 else "jpeg", quality=80)
        address = f"data:image/*;base64,{base64.b64encode(file.getvalue()).decode()}"
        clicks = [[u, curve(u) + 0.5 * (-1) ** i] for i, u in enumerate(at)]
        clicks[-1][1] += last
        return tab.page.evaluate(FOLLOW, [address, clicks])

    yield follow
    assert tab.problems == []


def markers(radius, edge, places):
    """Circles on the line, filled with white."""
    for u in places:
        off = np.hypot(U - u, V - curve(u)) - radius
        yield from [(off < 0, WHITE), (stroke(off, edge), BLACK)]


def dashes(width=3.3):
    """The line where its length is in a dash of 12 pixels; between them are 8 pixels."""
    grid = np.linspace(-20, WIDTH + 20, 8000)
    length = np.concatenate([[0], np.cumsum(np.hypot(np.diff(grid), np.diff(curve(grid))))])
    nearest = U + (V - curve(U)) * slope(U) / (1 + slope(U) ** 2)
    return cover(width) * (np.interp(nearest, grid, length) % 20 < 12)


BLACK, WHITE, YELLOW = (0, 0, 0), (255, 255, 255), (255, 230, 0)
SHADE = np.linspace(255, 140, WIDTH)[None, :, None] / 255
AXES = np.maximum(stroke(V - 200, 3), stroke(U - 15, 3))
TRANSPARENT = np.dstack([np.zeros((*U.shape, 3)), 255 * cover()])
# Picture, width of the line, and the share of the line that may be left out.
PRINTS = {
    "even light": (painted(WHITE, (cover(), BLACK)), 3.3, 0),
    "darker to the right": (painted(WHITE, (cover(), (30, 30, 30))) * SHADE, 3.3, 0),
    "darker to the left": (painted(WHITE, (cover(), (30, 30, 30))) * SHADE[:, ::-1], 3.3, 0),
    "light on dark": (painted((40, 40, 40), (cover(), (230, 230, 230))), 3.3, 0),
    "yellow beside black": (painted(WHITE, (cover(), YELLOW), (AXES, BLACK)), 3.3, 0.06),
    "transparent": (TRANSPARENT, 3.3, 0),
    "wide": (painted(WHITE, (cover(18), BLACK)), 18, 0),
    "thin": (painted(WHITE, (cover(1.3), BLACK)), 1.6, 0.05),
    "dashes": (painted(WHITE, (dashes(), BLACK)), 3.3, 0.6),
    "markers": (
        painted(WHITE, (cover(), BLACK), *markers(8.3, 2.9, range(60, 760, 75))),
        3.3,
        0.3,
    ),
    "small markers": (
        painted(WHITE, (cover(1.3), BLACK), *markers(2.8, 1.0, range(60, 760, 40))),
        1.6,
        0.3,
    ),
}


@pytest.mark.parametrize("name", PRINTS)
def test_a_line_is_followed_in_its_middle(name, followed):
    picture, width, most = PRINTS[name]
    found = followed(picture)
    assert "lost" not in found, found
    u, v = np.transpose(found["points"])
    error = (v - curve(u)) / np.hypot(1, slope(u))
    assert abs(error.mean()) < 0.05 and abs(error).max() < 0.25
    assert found["width"] == pytest.approx(width, rel=0.12)
    # At most 15 points, evenly along the line, and none behind the last click.
    assert 10 <= len(u) <= 15 and u[0] < 40 and 730 < u[-1] < 761
    assert np.hypot(np.diff(u), np.diff(v)).max() < 2.2 * found["length"] / 14
    grid = np.linspace(20, 760, 2000)
    length = np.hypot(np.diff(grid), np.diff(curve(grid))).sum()
    assert found["length"] == pytest.approx(length, rel=0.02)
    assert found["left_out"] <= most * length and (found["left_out"] > 0) == (most > 0.05)


def test_a_line_that_ends_is_lost_between_the_clicks_that_are_named(followed):
    ends = painted(WHITE, (cover() * (U < 450), BLACK))
    found = followed(ends)
    assert found["leg"] == 3 and found["move"] == 4 and 450 < found["lost"][0] < 520
    found = followed(painted(WHITE))
    assert found["leg"] == 1 and found["move"] == 1


def test_the_line_is_left_at_the_last_click(followed):
    u, _ = np.transpose(followed(PRINTS["even light"][0], at=(20, 200, 400))["points"])
    assert 385 < u[-1] < 401
    found = followed(PRINTS["even light"][0], at=(20, 200, 400), last=20)
    assert found["move"] == 3 and 380 < found["lost"][0] < 420


def test_a_picture_of_forty_megapixels_is_followed(tab, followed):
    """Only the tiles along the line are read."""
    seconds = tab.evaluate("""(async () => {
      const canvas = Object.assign(document.createElement("canvas"), { width: 8000, height: 5000 });
      const pen = canvas.getContext("2d");
      pen.lineWidth = 14;
      pen.moveTo(100, 100);
      pen.lineTo(7900, 4900);
      pen.stroke();
      Object.assign(canvas, { naturalWidth: 8000, naturalHeight: 5000 });
      const start = performance.now();
      const { points, width } = trace.follow(colours_of(canvas), [[110, 106], [7890, 4894]]);
      if (points.length !== 15 || Math.abs(width - 14) > 0.5) throw new Error(`${width}`);
      return (performance.now() - start) / 1000;
    })()""")
    assert seconds < 10


def test_where_another_line_runs_into_it_a_line_is_left_out_up_to_the_next_click(followed):
    """Between 330 and 440 both are one stroke of twice the width."""
    beside = np.clip(np.abs(U - 385) - 55, 0, None) * 0.25  # px, between the middles of both
    off = (V - curve(U)) / np.hypot(1, slope(U))
    other = stroke(off - beside - 2.5, 3.3)
    picture = painted(WHITE, (cover(), BLACK), (other, BLACK))
    found = followed(picture, at=(20, 120, 220, 300, 480, 560, 660, 760))
    assert "lost" not in found and len(found["points"]) >= 8
    u, v = np.transpose(found["points"])
    assert np.abs((v - curve(u)) / np.hypot(1, slope(u))).max() < 1.0
    assert found["left_out"] > 100
