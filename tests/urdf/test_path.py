"""Which joints lie between two links, and every way in which that can fail, by name."""

from __future__ import annotations

from pathlib import Path

import pytest

from kinsym.errors import RobotError
from kinsym.robot.urdf.document import Urdf, read_urdf
from kinsym.robot.urdf.path import joints_between
from tests.urdf.trees import J, panda, scara, urdf, write


def tree(folder: Path, text: str) -> Urdf:
    return read_urdf(write(folder, text), shown_as="arm.urdf")


def chosen(urdf: Urdf, base: str | None = None, tip: str | None = None) -> list[str]:
    return [joint.name for joint in joints_between(urdf, base, tip, where="arm.urdf")]


def test_from_the_root_to_the_only_leaf(tmp_path: Path) -> None:
    found = tree(tmp_path, urdf(J("j2", "revolute", "b", "c"), J("j1", "fixed", "a", "b")))
    assert chosen(found) == ["j1", "j2"]
    assert chosen(found, base="b") == ["j2"]


def test_a_mimic_joint_and_a_floating_one_beside_the_chain_do_no_harm(tmp_path: Path) -> None:
    assert chosen(tree(tmp_path, panda()), tip="panda_link2") == ["panda_joint1", "panda_joint2"]
    floating = J("free", "floating", "world", "base")
    assert chosen(tree(tmp_path, urdf(floating, J("j1", "revolute", "base", "tool"))), base="base") == ["j1"]
    apart = urdf(J("j1", "revolute", "a", "b"), J("k1", "revolute", "x", "y"))
    assert chosen(tree(tmp_path, apart), tip="y") == ["k1"]


ROW = urdf(J("j1", "revolute", "a", "b"), J("j2", "revolute", "b", "c"), J("j3", "fixed", "c", "d"))
RING = urdf(J("j1", "revolute", "a", "b"), J("j2", "revolute", "b", "a"))


def test_a_leaf_that_does_not_move_is_no_end(tmp_path: Path) -> None:
    """A camera at the foot of an arm."""
    camera = J("mount", "fixed", "base", "camera")
    assert chosen(tree(tmp_path, urdf(camera, J("j1", "revolute", "base", "tool")))) == ["j1"]


REFUSED: dict[str, tuple[str, str | None, str | None, tuple[str, ...]]] = {
    "unknown tip": (ROW, None, "e", ("--tip-link: there is no link 'e'", "The links are a, b, c, d")),
    "nearest base": (
        panda(),
        "panda_lnk0",
        None,
        ("--base-link: there is no link 'panda_lnk0'", "Did you mean panda_link0?", "rightfinger"),
    ),
    "two leaves": (panda(), None, None, ("2 chains begin at 'panda_link0'", "leftfinger, rightfinger")),
    "mimic at the end": (
        panda(),
        None,
        "rightfinger",
        ("joint finger_2: the joint mimics 'finger_1'", "end the chain before it with --tip-link"),
    ),
    "mimic inside": (scara("j4"), None, "tool", ("joint j4: the joint mimics 'j2'", "no variable of its own")),
    "floating": (
        urdf(J("free", "floating", "w", "a"), J("j1", "revolute", "a", "b")),
        None,
        None,
        ("joint free: the joint is floating: it has six variables", "--base-link"),
    ),
    "planar": (urdf(J("j1", "planar", "w", "a")), None, None, ("the joint is planar: it has three variables",)),
    "no direction": (
        urdf(J("j1", "revolute", "a", "b", axis="0 0 0")),
        None,
        None,
        ("joint j1, axis xyz: the axis has no direction", '"0 0 1"'),
    ),
    "reversed": (ROW, "c", "a", ("'c' lies below 'a'", "Exchange --base-link and --tip-link")),
    "two branches": (panda(), "leftfinger", "rightfinger", ("'rightfinger' does not lie below 'leftfinger'",)),
    "nothing moves": (ROW, "c", "d", ("no joint moves between 'c' and 'd'",)),
    "one link": (ROW, "c", "c", ("no joint moves between 'c' and 'c'",)),
    "two roots": (
        urdf(J("j1", "revolute", "a", "b"), J("k1", "revolute", "x", "y")),
        None,
        None,
        ("2 links without a parent", "--base-link: a, x"),
    ),
    "ring": (RING, None, None, ("the links form a ring",)),
    "ring with a base": (RING, "a", None, ("the links form a ring",)),
    "ring with a tip": (RING, None, "a", ("the links form a ring",)),
    "ten joints": (
        urdf(*(J(f"j{i}", "revolute", f"l{i}", f"l{i + 1}") for i in range(10))),
        None,
        None,
        ("10 joints move between 'l0' and 'l10'", "At most 9", "j9"),
    ),
}


@pytest.mark.parametrize(("text", "base", "tip", "words"), REFUSED.values(), ids=REFUSED)
def test_refusals_name_what_is_there(
    tmp_path: Path, text: str, base: str | None, tip: str | None, words: tuple[str, ...]
) -> None:
    with pytest.raises(RobotError) as caught:
        chosen(tree(tmp_path, text), base, tip)
    assert all(word in str(caught.value) for word in words), str(caught.value)


def test_a_fixed_joint_needs_no_axis(tmp_path: Path) -> None:
    found = tree(tmp_path, urdf(J("j1", "fixed", "a", "b", axis="0 0 0"), J("j2", "continuous", "b", "c")))
    assert chosen(found) == ["j1", "j2"]
