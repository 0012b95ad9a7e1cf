"""Files of compiled responses: what is written, and what is refused."""

import json
from pathlib import Path

import numpy as np
import pytest

from planarimpact import InputError, response

X = np.linspace(-9.5, 9.5, 2003)
CASES = [
    ("rigid", {"restitution": 0.3, "mass_ratio": 2.7}),
    ("laws.brach", {"tangential_restitution": 0.7}),
    ("lumped.hysteretic", {"mass_ratio": 8.0, "stiffness_ratio": 0.1}),
    ("timestep.linear", {"steps": 16}),
]


def compiled(model="lumped.hysteretic", tolerance=1e-3, **parameters):
    return response.compile(model, incidence_max=10, tolerance=tolerance, **parameters)


def assert_same(one, other):
    """Equal to the bit, NaN and all."""
    for a, b in zip(one[:4], other[:4], strict=True):
        np.testing.assert_array_equal(a, b)


@pytest.fixture(scope="module")
def ball():
    return compiled("lumped.hysteretic", 1e-10)


@pytest.fixture
def file(ball, tmp_path):
    ball.save(tmp_path / "ball.json")
    return tmp_path / "ball.json"


@pytest.mark.parametrize(("model", "parameters"), CASES)
def test_a_file_gives_the_same_answers_to_the_bit(tmp_path, model, parameters):
    found = compiled(model, **parameters)
    found.save(tmp_path / "it")
    again = response.load(tmp_path / "it")
    x = np.concatenate([X, [0.0, -0.0, 10.0, -10.0]])
    assert_same(again(x), found(x))
    np.testing.assert_array_equal(again.velocity(x), found.velocity(x))
    for name in ("model", "parameters", "incidence_max", "tolerance", "error_bound"):
        assert getattr(again, name) == getattr(found, name)
    assert [path.name for path in tmp_path.iterdir()] == ["it"]


@pytest.mark.parametrize("model", ["laws.brach", "laws.smith", "rigid", "lumped.hysteretic"])
def test_what_is_compiled_can_be_loaded(tmp_path, model):
    """Laws of impulses know friction from the end of the last piece on, by rounding or not."""
    for beta in (1.0, 1.3, 2.0, 2.5, 3.5, 4.7):
        for e in (0.0, 0.3, 0.7, 1.0):
            found = compiled(model, 1e-6, mass_ratio=beta, restitution=e)
            found.save(tmp_path / "it")
            assert response.load(tmp_path / "it").slides_from == found.slides_from


def test_a_file_may_be_named_by_text_and_written_again(file, ball):
    compiled("rigid").save(str(file))
    assert response.load(str(file)).model == "rigid"
    ball.save(file)
    first = file.read_bytes()
    response.load(file).save(file)
    assert file.read_bytes() == first


def test_a_file_is_as_documented(file):
    written = json.loads(file.read_text())
    assert (written["format"], written["version"]) == (response.FORMAT, response.VERSION)
    assert set(written["content"]) == {
        "model",
        "parameters",
        "incidence_max",
        "tolerance",
        "error_bound",
        "slides_from",
        "pieces",
    }
    assert written["content"]["incidence_max"] is None  # infinity
    assert set(written["content"]["pieces"]) == set(response.piecewise.Pieces._fields)


def refused(path, *words):
    with pytest.raises(InputError) as refusal:
        response.load(path)
    for word in (str(path), *words):
        assert word in str(refusal.value)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('"version": 1', '"version": 2', ["version 2", "compile it again"]),
        ('"version": 1', '"version": "1"', ["version '1'"]),
        ('"version": 1', '"version": true', ["version True"]),
        ('"version": 1', '"version": 1.0', ["version 1.0"]),
        (response.FORMAT, "another", ["format 'another'"]),
    ],
)
def test_another_version_or_format_is_refused(file, old, new, words):
    file.write_text(file.read_text().replace(old, new, 1))
    refused(file, *words)


@pytest.mark.parametrize("key", ["version", "tolerance", "mass_ratio", "kink"])
def test_a_key_that_is_there_twice_is_refused(file, key):
    """Another reader of JSON may take the first of two values."""
    text = file.read_text()
    file.write_text(text.replace(f'"{key}": ', f'"{key}": 2, "{key}": ', 1))
    refused(file, f"damaged: '{key}' is there twice")


def test_one_digit_changed_is_seen_wherever_it_is(file):
    """But for a last digit that leaves the number what it is."""
    text = file.read_text()
    digest, content = (json.loads(text)[key] for key in ("sha256", "content"))
    start = text.index('"sha256"')
    seen = 0
    for i in [i for i in range(start, len(text)) if text[i] in "12345678"][::601]:
        changed = f"{text[:i]}{int(text[i]) + 1}{text[i + 1 :]}"
        written = json.loads(changed)
        if written.get("content") == content and written.get("sha256") == digest:
            continue
        file.write_text(changed)
        refused(file, "damaged")
        seen += 1
    assert seen > 10


@pytest.mark.parametrize("share", [0.0, 0.001, 0.1, 0.5, 0.99, 0.99999])
def test_a_file_cut_short_is_refused(file, share):
    whole = file.read_bytes()
    file.write_bytes(whole[: int(share * (len(whole) - 2))])
    refused(file, "damaged")


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"\n",
        b"\x00\xff\xfe\x80" * 99,
        b"{}",
        b"[]",
        b"null",
        b"3",
        b'"text"',
        b"{'format': 1}",
    ],
)
def test_what_is_no_such_file_is_refused(tmp_path, content):
    path = tmp_path / "other"
    path.write_bytes(content)
    refused(path, "damaged")


def test_content_that_is_missing_is_refused(file):
    written = json.loads(file.read_text())
    for key in ("content", "sha256"):
        file.write_text(json.dumps({k: v for k, v in written.items() if k != key}))
        refused(file, "damaged")


def test_an_error_while_writing_leaves_the_old_file_whole(file, monkeypatch):
    before = file.read_bytes()

    def full(path, text, **_):
        with open(path, "w") as stream:
            stream.write(text[: len(text) // 2])
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "write_text", full)
    with pytest.raises(OSError, match="No space"):
        compiled("rigid").save(file)
    assert file.read_bytes() == before
    with pytest.raises(OSError, match="No space"):
        compiled("rigid").save(file.with_name("new.json"))
    assert not file.with_name("new.json").exists()


def test_no_folder_no_file(tmp_path, ball):
    with pytest.raises(InputError, match="no folder"):
        ball.save(tmp_path / "nowhere" / "ball.json")
    assert not list(tmp_path.iterdir())


def test_a_failed_save_leaves_nothing(tmp_path):
    (tmp_path / "taken").mkdir()
    with pytest.raises(InputError, match="no regular file"):
        compiled("lumped.hysteretic").save(tmp_path / "taken")
    assert [path.name for path in tmp_path.iterdir()] == ["taken"]


def test_settings_of_numpy_are_saved(tmp_path):
    settings = {"steps": np.int64(32)}
    found = response.compile("timestep.linear", incidence_max=8, tolerance=1e-2, **settings)
    found.save(tmp_path / "file.json")
    assert response.load(tmp_path / "file.json").parameters["steps"] == 32
