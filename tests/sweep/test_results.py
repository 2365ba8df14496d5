"""What becomes of an answer: a table, arrays, a map, a volume cut open."""

from __future__ import annotations

import io

import numpy as np
import pytest
from matplotlib.text import Text

from kinsym.errors import RobotError
from kinsym.plot import workspace as drawn
from kinsym.workspace.files import data
from kinsym.workspace.sweeping import found, sweep
from tests.sweep.questions import planar, some


def test_the_table() -> None:
    lines = data(some(), "csv").decode().splitlines()
    assert lines[0] == "x,y,z,orientations_reached,orientations_tried,inside"
    assert lines[1:3] == ["0.0,0.0,0.0,0,4,0", "0.0,0.5,0.0,1,4,1"]
    assert len(lines) == 7
    assert [line[-1] for line in data(some("dexterous"), "csv").decode().splitlines()[1:]] == list("000010")


def test_the_arrays() -> None:
    content = data(some(), "npz")
    assert content == data(some(), "npz")
    arrays = np.load(io.BytesIO(content))
    assert arrays["hits"].shape == arrays["inside"].shape == (3, 2, 1)
    assert arrays["x"].tolist() == [0.0, 0.5, 1.0]
    assert int(arrays["tried"]) == 4


def test_a_slice_is_a_map() -> None:
    """Each point at its place, with white where nothing is reached, and circles on the closed border."""
    result = sweep(planar(21))
    ax = drawn(result, unit="m")
    (image,) = ax.images
    assert (result.inside[..., 0] == ~np.ma.getmaskarray(image.get_array()).T).all()
    step = result.question.x[1] - result.question.x[0]
    left, right, *_ = image.get_extent()
    assert (left, right) == pytest.approx((result.question.x[0] - step / 2, result.question.x[-1] + step / 2))
    assert [patch.radius for patch in ax.patches] == pytest.approx([0.15, 0.65])
    assert [text.get_text() for text in ax.figure.legends[0].get_texts()] == [
        "reached",
        "border in closed form",
        "base",
    ]
    assert ax.get_xlabel() == "x [m]"
    (image,) = drawn(some()).images
    assert (some().inside[..., 0] == ~np.ma.getmaskarray(image.get_array()).T).all()


def test_points_that_are_reached_but_not_with_every_orientation_are_told() -> None:
    """On the map of the dexterous workspace they are grey; where none is reached at all nothing is said of them."""
    legend = drawn(some("dexterous")).figure.legends[0]
    assert "reached with some orientations" in [text.get_text() for text in legend.get_texts()]
    nothing = found(some("dexterous").question, np.zeros(6, dtype=int))
    assert not any("some orientations" in text.get_text() for text in drawn(nothing).figure.findobj(Text))


def test_a_volume_is_cut_open() -> None:
    result = found(some(shape=(4, 4, 4)).question, np.full(64, 4))
    ax = drawn(result)
    ax.figure.draw_without_rendering()
    assert ax.name == "3d"
    assert len(ax.collections[0].get_facecolor()) == 16 + 16 + 16
    with pytest.raises(RobotError, match='projection="3d"'):
        drawn(result, drawn(some()))
    with pytest.raises(RobotError, match="in the plane"):
        drawn(some(), ax)


@pytest.mark.parametrize("kind", ["reachable", "dexterous"])
def test_an_empty_workspace_is_said(kind: str) -> None:
    for shape in ((3, 2, 1), (3, 3, 3)):
        nothing = found(some(kind, shape).question, np.zeros(np.prod(shape), dtype=int))
        ax = drawn(nothing)
        ax.figure.draw_without_rendering()
        assert "no point of the grid is inside" in ax.figure.texts[1].get_text()
