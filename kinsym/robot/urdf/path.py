"""The joints from one link of a URDF tree to another."""

from __future__ import annotations

from kinsym.errors import RobotError
from kinsym.robot.names import nearest, shown
from kinsym.robot.rows import MOST_JOINTS
from kinsym.robot.urdf.document import Urdf, UrdfJoint

MOST_SHOWN = 40
_MOVING = ("revolute", "continuous", "prismatic")


def joints_between(urdf: Urdf, base: str | None, tip: str | None, *, where: str) -> tuple[UrdfJoint, ...]:
    """The joints that lead from the link ``base`` down to the link ``tip``, fixed ones included.

    Without ``base`` the path begins at the root of the tree, without ``tip`` it ends at the only leaf below the base
    that moves.
    Raises RobotError where a link does not exist, the choice is not unique, no path leads down, or a joint of the
    path is none of a serial arm (floating, planar, mimic), and where nothing on the path moves.
    """
    above = {joint.child: joint for joint in urdf.joints}
    for option, link in (("--base-link", base), ("--tip-link", tip)):
        if link is not None and link not in urdf.links:
            raise RobotError(
                f"there is no link {shown(link)}",
                where=f"{where}, {option}",
                remedy=f"{nearest(link, urdf.links)}The links are {_listed(urdf.links)}.",
            )
    start = base if base is not None else _root(urdf, above, tip, where)
    end = tip if tip is not None else _leaf(urdf, start, where)
    path: list[UrdfJoint] = []
    here = end
    while here != start:
        if here not in above or len(path) > len(urdf.joints):
            raise _no_path(urdf, above, start, end, where)
        path.append(above[here])
        here = above[here].parent
    path.reverse()
    for joint in path:
        _check_kind(joint)
    moving = [joint.name for joint in path if joint.kind in _MOVING]
    if len(moving) > MOST_JOINTS:
        raise RobotError(
            f"{len(moving)} joints move between {shown(start)} and {shown(end)}",
            where=where,
            remedy=f"At most {MOST_JOINTS} can: choose --base-link and --tip-link. They are {_listed(moving)}.",
        )
    if not moving:
        raise RobotError(
            f"no joint moves between {shown(start)} and {shown(end)}",
            where=where,
            remedy=f"Choose --base-link and --tip-link of {_listed(urdf.links)}.",
        )
    return tuple(path)


def _root(urdf: Urdf, above: dict[str, UrdfJoint], tip: str | None, where: str) -> str:
    """The link that the tip hangs on in the end; without a tip the only root of the file."""
    roots = [link for link in urdf.links if link not in above]
    if tip is not None:
        here, steps = tip, 0
        while here in above and steps <= len(urdf.joints):
            here, steps = above[here].parent, steps + 1
        roots = [here] if here not in above else []
    if len(roots) == 1:
        return roots[0]
    if not roots:
        raise RobotError("the links form a ring", where=where, remedy="The links of a URDF form a tree; cut it.")
    raise RobotError(
        f"the file has {len(roots)} links without a parent",
        where=where,
        remedy=f"Name one with --base-link: {_listed(roots)}.",
    )


def _leaf(urdf: Urdf, start: str, where: str) -> str:
    """The only leaf that moves against the start; the only leaf where none does."""
    below: dict[str, list[UrdfJoint]] = {}
    for joint in urdf.joints:
        below.setdefault(joint.parent, []).append(joint)
    leaves: dict[str, bool] = {}
    moves, waiting = {start: False}, [start]
    while waiting:
        here = waiting.pop()
        for joint in below.get(here, []):
            if joint.child not in moves:
                moves[joint.child] = moves[here] or joint.kind != "fixed"
                waiting.append(joint.child)
        if here not in below:
            leaves[here] = moves[here]
    if not leaves:
        raise RobotError("the links form a ring", where=where, remedy="The links of a URDF form a tree; cut it.")
    ends = [link for link in urdf.links if leaves.get(link, False)] or sorted(leaves, key=urdf.links.index)
    if len(ends) == 1:
        return ends[0]
    raise RobotError(
        f"{len(ends)} chains begin at {shown(start)}",
        where=where,
        remedy=f"Name the end of one with --tip-link: {_listed(ends)}, or a link before it.",
    )


def _no_path(urdf: Urdf, above: dict[str, UrdfJoint], start: str, end: str, where: str) -> RobotError:
    upward, steps = start, 0
    while upward in above and upward != end and steps <= len(urdf.joints):
        upward, steps = above[upward].parent, steps + 1
    if upward == end:
        return RobotError(
            f"{shown(start)} lies below {shown(end)}", where=where, remedy="Exchange --base-link and --tip-link."
        )
    return RobotError(
        f"{shown(end)} does not lie below {shown(start)}",
        where=where,
        remedy=f"Choose --base-link and --tip-link on one branch; the links are {_listed(urdf.links)}.",
    )


def _check_kind(joint: UrdfJoint) -> None:
    if joint.mimic is not None and joint.kind in _MOVING:
        raise RobotError(
            f"the joint mimics {shown(joint.mimic)}: it has no variable of its own",
            where=joint.where,
            remedy="A serial arm has independent joints; end the chain before it with --tip-link.",
        )
    if joint.kind not in (*_MOVING, "fixed"):
        freedoms = {"floating": "six", "planar": "three"}[joint.kind]
        raise RobotError(
            f"the joint is {joint.kind}: it has {freedoms} variables",
            where=joint.where,
            remedy="Begin or end the chain at another link with --base-link or --tip-link.",
        )
    if joint.kind in _MOVING and not any(joint.axis):
        raise RobotError(
            "the axis has no direction", where=f"{joint.where}, axis xyz", remedy='Write, for example, "0 0 1".'
        )


def _listed(links: tuple[str, ...] | list[str]) -> str:
    names = [shown(link)[1:-1] for link in links[:MOST_SHOWN]]
    return ", ".join(names) + (f" and {len(links) - MOST_SHOWN} more" if len(links) > MOST_SHOWN else "")
