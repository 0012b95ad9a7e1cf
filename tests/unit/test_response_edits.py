"""Files of responses whose content was edited, and the hash made anew: refused, or still right."""

import copy
import functools
import json

import numpy as np
import pytest

from planarimpact import InputError, models, response

# Tolerance and parameters, and how many edits there are to each one that is tried.
CASES = {
    "lumped.hysteretic": (1e-4, {"mass_ratio": 3.0, "restitution": 0.5}, 1),
    "laws.brach": (1e-6, {"tangential_restitution": 0.7}, 1),  # no forces
    "timestep.linear": (1e-2, {"steps": 16}, 5),
    "continuum": (1e-2, {}, 11),  # has a tolerance of its own
}
ANYTHING = (None, -1, 0, 1e300, 10**400, float("inf"), float("nan"), "a text", True, [], {})
NUDGES = (1 - 1e-9, 1 + 1e-6, 1.001, 0.9, -1)
ROUNDING = 1e-13


@functools.cache
def compiled(model):
    tolerance, parameters, _ = CASES[model]
    return response.compile(model, incidence_max=8, tolerance=tolerance, **parameters)


@functools.cache
def asked(model, parameters):
    """Incidences, and what the model says of them."""
    end = compiled(model).pieces.end
    x = np.concatenate([np.linspace(0, end, 60), compiled(model).pieces.start, [1e-9, end + 1]])
    x = x[x <= compiled(model).incidence_max]
    return x, models.rebound(model, x, **dict(parameters))


@functools.cache
def content_of(model, folder):
    compiled(model).save(folder / "response.json")
    return json.loads((folder / "response.json").read_text())["content"]


def write(path, content):
    head = {"format": response.FORMAT, "version": response.VERSION}
    digest = response._digest(content)
    path.write_text(json.dumps(head | {"sha256": digest, "content": content}))


def places(node, path=()):
    """Every container and leaf of a tree, but of a long list the ends and the middle alone."""
    yield path
    if isinstance(node, dict):
        for key in node:
            yield from places(node[key], (*path, key))
    elif isinstance(node, list):
        for i in sorted({0, len(node) // 2, len(node) - 1} & set(range(len(node)))):
            yield from places(node[i], (*path, i))


def edits(node):
    """What may stand in place of a node."""
    yield from ANYTHING
    if isinstance(node, (int, float)):
        yield from (node * nudge for nudge in NUDGES)
        yield node + 1
    if isinstance(node, list):
        yield from (node[:-1], node + node[-1:], node[::-1], [*node[1:], *node[:1]])
    if isinstance(node, dict):
        yield node | {"more": 1}
        for key in node:
            yield {other: value for other, value in node.items() if other != key}
        values = list(node.values())
        yield dict(zip(node, values[1:] + values[:1], strict=True))


def edited(content):
    """Every edit of a content: its words, and the content."""
    for path in places(content):
        node = functools.reduce(lambda at, key: at[key], path, content)
        for new in edits(node):
            changed = copy.deepcopy(content)
            if path:
                functools.reduce(lambda at, key: at[key], path[:-1], changed)[path[-1]] = new
            else:
                changed = new
            if repr(changed) != repr(content):
                yield f"{'.'.join(map(str, path))} = {new!r:.80}", changed


def is_right(found):
    """Whether a response answers as its model does, within its own bound, where it claims to."""
    x, exact = asked(found.model, tuple(found.parameters.items()))
    answer = found(x[x <= found.incidence_max])
    for name, bound in found.error_bound._asdict().items():
        one, other = getattr(answer, name), getattr(exact, name)[: answer.velocity.size]
        same = (np.abs(one - other) <= bound + ROUNDING) | (np.isnan(one) & np.isnan(other))
        if not same.all():
            return False
    return np.mean(answer.regime == exact.regime[: answer.regime.size]) > 0.95


SLOW = "timestep.linear", "continuum"


@pytest.mark.parametrize(
    "model", [pytest.param(m, marks=[pytest.mark.slow] * (m in SLOW)) for m in CASES]
)
def test_what_was_edited_is_refused_by_name_or_still_right(model, tmp_path):
    path, refused = tmp_path / "edited.json", 0
    tried = list(edited(content_of(model, tmp_path)))[:: CASES[model][2]]
    for words, content in tried:
        write(path, content)
        try:
            found = response.load(path)
        except InputError as error:
            assert str(error).startswith(f"{path}: ") and "\n" not in str(error), words
            assert len(str(error)) < 500, words  # the names of all models are 200 of them
            refused += 1
        else:
            assert is_right(found), words
    assert len(tried) / 2 < refused < len(tried)
