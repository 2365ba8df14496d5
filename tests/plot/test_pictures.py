"""Pictures: of the right kind, true to scale, the same at every run, and refused where they would be wrong."""

from __future__ import annotations

import re
from itertools import pairwise
from typing import Any

import matplotlib
import numpy as np
import pytest
from matplotlib.figure import Figure

from kinsym.errors import RobotError
from kinsym.live import LiveArm, live
from kinsym.plot import branches, plain_style, rendered, skeleton, style
from kinsym.plot.branches import solutions
from kinsym.plot.parts import painted, parts
from kinsym.plot.solids import Solids, arrow, ball, box, projected, tube
from kinsym.robot import load
from kinsym.skeleton import linkage

POSTURE = np.radians([20.0, -70.0, 80.0, -40.0, -60.0, 30.0])


@pytest.fixture(scope="module")
def ur5() -> LiveArm:
    return live(load("ur5"))


@pytest.fixture(scope="module")
def puma() -> LiveArm:
    return live(load("puma560"))


@pytest.fixture(scope="module")
def planar() -> LiveArm:
    return live(load("planar_rr"), {"l1": 0.4, "l2": 0.3})


def solids(ax: Any) -> Solids:
    (found,) = (item for item in ax.collections if isinstance(item, Solids))
    return found


def test_scales_are_equal_in_space(puma: LiveArm) -> None:
    """As long on every axis: steps along x, y and z are seen from the diagonal with equal lengths."""
    ax = skeleton(puma)
    ax.view_init(elev=np.degrees(np.arctan(1.0 / np.sqrt(2.0))), azim=45.0)
    ax.apply_aspect()
    middle = np.array([np.mean(getattr(ax, f"get_{name}lim")()) for name in "xyz"])
    seen = ax.transData.transform(projected(ax, np.vstack([middle, middle + 0.1 * np.eye(3)]))[:, :2])
    lengths = np.linalg.norm(seen[1:] - seen[0], axis=1)
    assert np.ptp(lengths) < 1e-6 * lengths.max()


def test_scales_are_equal_in_the_plane(planar: LiveArm) -> None:
    ax = skeleton(planar, [0.5, 0.7], unit="m")
    ax.apply_aspect()
    origin, x, y = ax.transData.transform([[0.0, 0.0], [0.1, 0.0], [0.0, 0.1]])
    assert np.linalg.norm(x - origin) == pytest.approx(np.linalg.norm(y - origin))
    assert ax.get_xlabel() == "x [m]"


@pytest.mark.parametrize("joints", [None, POSTURE])
def test_all_of_the_arm_is_in_the_picture(ur5: LiveArm, joints: Any) -> None:
    ax = skeleton(ur5, joints)
    ax.figure.draw_without_rendering()
    shown = np.concatenate([path.vertices for path in solids(ax).get_paths()])
    dots = ax.transData.transform(shown)
    assert (dots > 0.0).all()
    assert (dots < ax.figure.bbox.size).all()


def test_names_cover_nothing(puma: LiveArm) -> None:
    """The middles of the names are a name's width apart, and off the links."""
    ax = skeleton(puma)
    texts = [text for text in ax.texts if text.get_text().startswith("$")]
    assert [text.get_text() for text in texts] == [f"$\\theta_{{{k}}}$" for k in range(1, 7)]
    places = ax.transData.transform(projected(ax, np.array([text.get_position_3d() for text in texts]))[:, :2])
    gaps = np.linalg.norm(places[:, None] - places, axis=-1) + 1e3 * np.eye(6)
    assert gaps.min() > 15.0


def test_bodies_look_outward() -> None:
    """A facet that looked inward would be left out where it should be seen."""
    frame = np.eye(4)
    frame[:3, 3] = 1.0, 2.0, 3.0
    start, end = np.array([1.0, 2.0, 3.0]), np.array([2.0, 2.5, 4.0])
    for body in (
        tube(start, end, 0.1, "k"),
        tube(start, end, 0.1, "k", tip=0.0),
        box(frame, 0.2, 0.5, "k"),
        ball(start, 0.2, "k"),
    ):
        middle = np.concatenate(body.facets).mean(axis=0)
        for facet in body.facets:
            normal = np.cross(facet, np.roll(facet, -1, axis=0)).sum(axis=0)
            assert normal @ (facet.mean(axis=0) - middle) >= -1e-12
    assert not tube(start, start, 0.1, "k").facets
    assert arrow(start, end, 0.1, "k", lift=0.5).lift == 0.5


def test_what_is_in_front_hides_what_is_behind() -> None:
    ax = Figure().add_subplot(projection="3d")
    ax.view_init(elev=0.0, azim=0.0)
    ax.set_proj_type("ortho")
    near, far = np.eye(4), np.eye(4)
    near[0, 3], far[0, 3] = 0.9, 0.1
    drawn = Solids([box(near, 0.1, 0.1, "#ff0000"), box(far, 0.1, 0.1, "#0000ff")])
    ax.add_collection(drawn)
    drawn.do_3d_projection()
    faces = drawn.get_facecolor()
    assert len(faces) == 2  # of each box the side that looks at the viewer
    assert faces[0][2] > faces[0][0]  # the blue one first, so that the red one covers it
    assert faces[1][0] > faces[1][2]


def test_the_sides_that_look_at_the_viewer_are_drawn() -> None:
    """Seen from little above, the middle of the visible sides of a box is above that of the box."""
    ax = Figure().add_subplot(projection="3d")
    ax.view_init(elev=20.0, azim=30.0)
    cube = box(np.eye(4), 0.5, 0.5, "#ff0000")
    drawn = Solids([cube])
    ax.add_collection(drawn)
    drawn.do_3d_projection()
    assert len(drawn.get_paths()) == 3
    corners = np.concatenate([path.vertices[:4] for path in drawn.get_paths()])
    assert corners[:, 1].mean() > projected(ax, np.concatenate(cube.facets))[:, 1].mean() + 1e-3


def test_solutions_that_look_alike_are_one_arm(puma: LiveArm, ur5: LiveArm) -> None:
    """A wrist with its axes in a point turns over in place; that of a UR5 does not."""
    pose = puma.fk(np.radians([30.0, 45.0, -150.0, -45.0, 90.0, 75.0]))
    drawn = solutions(puma, linkage(puma), pose)
    assert [item.places for item in drawn] == [(0, 1), (2, 3), (4, 5), (6, 7)]
    assert drawn[0].label(puma.module.BRANCHES) == "0, 1:  shoulder left, elbow up"
    found = solutions(ur5, linkage(ur5), ur5.fk(POSTURE))
    assert [item.places for item in found] == [(k,) for k in range(8)]
    for item in found:
        assert np.allclose(ur5.fk(item.q), ur5.fk(POSTURE), atol=1e-9)


def test_what_all_branches_share_has_a_colour_of_its_own(ur5: LiveArm) -> None:
    shape = linkage(ur5)
    arms = [list(parts(shape, shape.at(item.q), 1.0)) for item in solutions(ur5, shape, ur5.fk(POSTURE))]
    shown = list(painted(arms, [str(k) for k in range(8)], 1.0))
    base = [colour for part, colour in shown if part.kind == "turn" and np.allclose(part.frame[:2, 3], 0.0)]
    assert style.SHARED in base
    elbows = [colour for part, colour in shown if part.kind == "link" and colour != style.SHARED]
    assert set(elbows) == {str(k) for k in range(8)}
    keys = [part.key(1.0) for part, _ in shown]
    assert len(keys) == len(set(keys))


def test_a_legend_names_every_arm_and_covers_none(ur5: LiveArm) -> None:
    ax = branches(ur5, ur5.fk(POSTURE))
    ax.figure.draw_without_rendering()
    (legend,) = ax.figure.legends
    labels = [text.get_text() for text in legend.get_texts()]
    assert labels == [f"{k}:  {name}" for k, name in enumerate(ur5.module.BRANCHES)]
    lowest = ax.transData.transform(np.concatenate([path.vertices for path in solids(ax).get_paths()]))[:, 1].min()
    assert legend.get_window_extent().y1 < lowest


def test_the_tool_is_drawn_where_all_solutions_agree(planar: LiveArm, puma: LiveArm) -> None:
    """Two arms that reach a point with different orientations have no tool frame in common."""
    arrows = [
        patch
        for patch in branches(planar, planar.fk(np.array([0.5, 0.7]))).patches
        if type(patch).__name__ == "FancyArrow"
    ]
    assert len(arrows) == 2
    both = [patch for patch in skeleton(planar, [0.5, 0.7]).patches if type(patch).__name__ == "FancyArrow"]
    assert len(both) == 4


def test_given_axes_are_drawn_into(puma: LiveArm, planar: LiveArm) -> None:
    figure = Figure()
    flat, space = figure.add_subplot(1, 2, 1), figure.add_subplot(1, 2, 2, projection="3d")
    assert skeleton(planar, [0.5, 0.7], flat) is flat
    assert branches(puma, puma.fk(np.full(6, 0.5)), space) is space
    assert not figure.texts  # the titles are the caller's
    with pytest.raises(RobotError, match='projection="3d"'):
        skeleton(puma, None, flat)


@pytest.mark.parametrize(
    ("q", "message"),
    [
        ([0.1], r"shape \(1,\), the arm has 6 joints"),
        ([np.nan] * 6, "not finite"),
        (["a"] * 6, "no numbers"),
        (np.zeros((2, 6)), "shape"),
    ],
)
def test_joint_values_that_are_none(puma: LiveArm, q: Any, message: str) -> None:
    with pytest.raises(RobotError, match=message):
        skeleton(puma, q)


@pytest.mark.parametrize(
    ("pose", "message"),
    [
        (np.diag([1.0, 1.0, 1.0, 2.0]), "no pose"),
        (np.full((4, 4), np.nan), "no pose"),
        (np.eye(3), "shape"),
        ("x", "the pose is no matrix of numbers"),
    ],
)
def test_poses_that_are_none(puma: LiveArm, pose: Any, message: str) -> None:
    with pytest.raises(RobotError, match=message):
        branches(puma, pose)


def test_a_pose_out_of_reach(puma: LiveArm) -> None:
    far = np.eye(4)
    far[0, 3] = 5.0
    with pytest.raises(RobotError, match="out of reach"):
        branches(puma, far)


def test_the_same_bytes_whatever_the_user_has_set(puma: LiveArm) -> None:
    """No date, no random names, none of the user's settings."""
    texts = []
    for size in (10.0, 30.0):
        with (
            matplotlib.rc_context(
                {"font.size": size, "font.family": "serif" if size > 20.0 else "sans-serif", "svg.hashsalt": str(size)}
            ),
            plain_style(),
        ):
            texts.append(rendered(skeleton(puma), "svg"))
    assert texts[0] == texts[1]
    assert not re.search(rb"\d{4}-\d{2}-\d{2}T|matplotlib v", texts[0], re.IGNORECASE)
    assert len(texts[0]) < 250_000
    assert rendered(skeleton(puma), "png").startswith(b"\x89PNG")


def test_a_sliding_joint_is_square_and_a_turning_one_round() -> None:
    shape = linkage(load("stanford_arm"))
    posture = shape.at(np.array([0.3, 0.8, 0.4, 0.1, 0.2, 0.3]))
    found = list(parts(shape, posture, 1.0))
    assert [part.kind for part in found if part.kind in ("turn", "slide")] == [
        "turn",
        "turn",
        "slide",
        "turn",
        "turn",
        "turn",
    ]
    (rod,) = (part for part in found if part.kind == "rod")
    assert np.linalg.norm(rod.end - rod.start) == pytest.approx(0.4)
    for before, after in pairwise(part for part in found if part.kind in ("link", "rod")):
        assert np.allclose(before.end, after.start)
