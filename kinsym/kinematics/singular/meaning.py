"""What a singular condition means on the arm: which axes coincide, where the wrist centre lies.

Every sentence is a property of axes and points. It is said if it holds at random postures of the condition and not at
random postures of the arm, all modulo the prime; the first of the list that fits is taken.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import combinations

from kinsym.algebra.field import PRIME, inverse
from kinsym.algebra.linear import Numbers, cross, difference, dot, kernel
from kinsym.kinematics.singular.posture import Posture
from kinsym.robot.model import Task

WRIST, ELBOW, SHOULDER = "wrist", "elbow", "shoulder"

#: Tasks in which it matters where the end point is, not only how the end effector is turned.
WITH_AN_END = (Task.POSITION, Task.POSITION_AXIS)
#: In how many directions a point can move.
_DIRECTIONS = 3
_MOVED = {Task.POSITION: "the end point", Task.ORIENTATION: "the orientation"}


@dataclass(frozen=True)
class Meaning:
    """The usual name of a singularity, empty where there is none, and the geometry behind it."""

    name: str
    reason: str


@dataclass(frozen=True)
class _Place:
    """A point of the arm: how it is called, which joints pass through it, where it is."""

    words: str
    joints: tuple[int, ...]
    at: Callable[[Posture], Numbers]


_Property = tuple[Meaning, Callable[[Posture], bool]]


def meaning(task: Task, singular: list[Posture], ordinary: list[Posture]) -> Meaning:
    """The meaning of a condition from postures on it and postures of the arm."""
    for found, holds in _properties(task, ordinary[0]):
        if all(map(holds, singular)) and not any(map(holds, ordinary)):
            return found
    return Meaning("", _dependent(task, singular))


def _properties(task: Task, ordinary: Posture) -> Iterator[_Property]:
    turning = [joint for joint, kind in enumerate(ordinary.kinds) if kind == "R"]
    listed = partial(_listed, ordinary)
    places = list(_places(task, ordinary))
    pairs = list(combinations(turning, 2))
    always_parallel = [pair for pair in pairs if _parallel(ordinary, *pair)]
    yield from _meeting(ordinary, turning)
    for place in places:
        for joint in turning:
            if joint not in place.joints:
                yield _on_axis(ordinary, place, joint, turning)
    yield from _in_one_plane(ordinary, always_parallel, places)
    planes = [
        (place, i, j)
        for place in places
        for i, j in sorted([*pairs, *(pair[::-1] for pair in pairs)], key=lambda pair: abs(pair[0] - pair[1]))
        if not {i, j} & set(place.joints) and (min(i, j), max(i, j)) not in always_parallel
    ]
    for place, i, j in planes:
        if i == turning[0]:
            yield _in_plane_of(ordinary, place, i, j, turning)
    for i, j in pairs:
        if (i, j) not in always_parallel:
            yield from _become_parallel(ordinary, turning, i, j)
    for place, i, j in planes:
        if i != turning[0]:
            yield _in_plane_of(ordinary, place, i, j, turning)
    for place in places:
        others = [joint for joint in range(len(ordinary.kinds)) if joint not in place.joints]
        if len(place.joints) == len(others) == _DIRECTIONS:
            words = f"joints {listed(others)} move {place.words} in fewer than 3 ways"
            yield Meaning("", words), partial(_slow, place=place, joints=others)
    for i, j in pairs:
        yield Meaning("", f"axes {listed((i, j))} meet"), partial(_meet, i=i, j=j)
    for triple in combinations(turning, 3):
        words = f"axes {listed(triple)} are parallel to one plane"
        yield Meaning("", words), partial(_flat, joints=triple)


def _places(task: Task, ordinary: Posture) -> Iterator[_Place]:
    """The points where consecutive axes meet, three before two, and the end point."""
    last = len(ordinary.kinds) - 1
    for count in (3, 2):
        for first in range(last - count + 1, -1, -1):
            joints = tuple(range(first, first + count))
            turning = all(ordinary.kinds[joint] == "R" for joint in joints)
            point = crossing(ordinary, *joints[:2]) if turning else None
            if point is None or (count == 3 and any(_lever(ordinary, joints[2], point))):
                continue
            words = f"the point where axes {_listed(ordinary, joints)} meet"
            if count == 3 and joints[-1] == last:
                words = "the wrist centre"
            yield _Place(words, joints, partial(_meeting_point, first=first))
    if task in WITH_AN_END:
        yield _Place("the end point", (), lambda p: p.end)


def _meeting(ordinary: Posture, turning: list[int]) -> Iterator[_Property]:
    """Three axes that always meet fall into one plane."""
    for i in range(len(ordinary.kinds) - 2):
        triple = (i, i + 1, i + 2)
        point = crossing(ordinary, i, i + 1) if set(triple) <= set(turning) else None
        if point is None or any(_lever(ordinary, i + 2, point)):
            continue
        name = WRIST if i + 2 == turning[-1] else SHOULDER if i == turning[0] else ""
        coincide = Meaning(name, f"axes {_listed(ordinary, (i, i + 2))} coincide")
        yield coincide, partial(_parallel, i=i, j=i + 2)
        plane = Meaning(name, f"axes {_listed(ordinary, triple)} lie in one plane")
        yield plane, partial(_flat, joints=triple)


def _on_axis(ordinary: Posture, place: _Place, joint: int, turning: list[int]) -> _Property:
    name = SHOULDER if joint == turning[0] else ""
    words = f"{place.words} lies on axis {ordinary.numbers[joint]}"
    return Meaning(name, words), lambda p: not any(_lever(p, joint, place.at(p)))


def _in_one_plane(
    ordinary: Posture, always_parallel: list[tuple[int, int]], places: list[_Place]
) -> Iterator[_Property]:
    """Parallel axes in one plane, with one another or with a point: the links between them are in line."""
    in_line = "the arm is stretched or folded"
    for i, j, k in combinations(range(len(ordinary.kinds)), 3):
        if {(i, j), (j, k)} <= set(always_parallel):
            words = f"axes {_listed(ordinary, (i, j, k))} lie in one plane: {in_line}"
            yield Meaning(ELBOW, words), partial(_coplanar, i=i, j=j, k=k)
    for place in places:
        for i, j in always_parallel:
            words = f"axes {_listed(ordinary, (i, j))} and {place.words} lie in one plane: {in_line}"
            yield Meaning(ELBOW, words), partial(_coplanar, i=i, j=j, k=place)


def _become_parallel(ordinary: Posture, turning: list[int], i: int, j: int) -> Iterator[_Property]:
    """Two axes become parallel, and with them all that are parallel to one of them."""
    left = [k for k in turning if k == i or _parallel(ordinary, min(i, k), max(i, k))]
    right = [k for k in turning if k == j or _parallel(ordinary, min(j, k), max(j, k))]
    if (i, j) != (left[0], right[0]):
        return
    name = WRIST if j == turning[-1] and len(turning) > 3 else ""
    if len(left) == len(right) == 1:
        words = f"axes {_listed(ordinary, (i, j))} are parallel"
    else:
        one, many = (left, right) if len(left) == 1 else (right, left)
        words = f"{_axes(ordinary, one)} {'is' if len(one) == 1 else 'are'} parallel to {_axes(ordinary, many)}"
    yield Meaning(name, words), lambda p: _parallel(p, i, j)


def _in_plane_of(ordinary: Posture, place: _Place, i: int, j: int, turning: list[int]) -> _Property:
    plane = f"of axes {_listed(ordinary, (i, j))}"
    if not _meet(ordinary, i, j):
        plane = f"through axis {ordinary.numbers[i]} parallel to axis {ordinary.numbers[j]}"
    name = SHOULDER if i == turning[0] else ""
    return Meaning(
        name, f"{place.words} lies in the plane {plane}"
    ), lambda p: _volume(p.axes[i], p.axes[j], difference(place.at(p), p.points[i])) == 0


def _dependent(task: Task, singular: list[Posture]) -> str:
    """Which joints no longer move the end effector independently."""
    moving: set[int] = set()
    for posture in singular:
        for vector in kernel(posture.jacobian(task)):
            moving |= {joint for joint, value in enumerate(vector) if value}
    moved = _MOVED.get(task, "the end effector")
    if len(moving) == 1:
        return f"joint {_listed(singular[0], sorted(moving))} does not move {moved}"
    if len(moving) == len(singular[0].kinds):
        return ""
    return f"joints {_listed(singular[0], sorted(moving))} move {moved} in fewer than {len(moving)} ways"


def _listed(posture: Posture, joints: Sequence[int]) -> str:
    """Numbers of joints in the table: 4, 5 and 6."""
    numbers = [str(posture.numbers[joint]) for joint in joints]
    return f"{', '.join(numbers[:-1])} and {numbers[-1]}" if len(numbers) > 1 else numbers[0]


def _axes(posture: Posture, joints: list[int]) -> str:
    return f"{'axis' if len(joints) == 1 else 'axes'} {_listed(posture, joints)}"


def _parallel(posture: Posture, i: int, j: int) -> bool:
    return not any(cross(posture.axes[i], posture.axes[j]))


def _volume(u: Numbers, v: Numbers, w: Numbers) -> int:
    return dot(cross(u, v), w)


def _lever(posture: Posture, joint: int, point: Numbers) -> Numbers:
    """The velocity that a joint gives to a point: zero on its axis."""
    return cross(posture.axes[joint], difference(point, posture.points[joint]))


def _slow(posture: Posture, place: _Place, joints: list[int]) -> bool:
    """Whether three joints give a point velocities in one plane."""
    velocities = [
        _lever(posture, joint, place.at(posture)) if posture.kinds[joint] == "R" else posture.axes[joint]
        for joint in joints
    ]
    return _volume(*velocities) == 0


def _meet(posture: Posture, i: int, j: int) -> bool:
    """Whether two axes lie in one plane; parallel ones are said to be parallel before."""
    gap = difference(posture.points[j], posture.points[i])
    return _volume(posture.axes[i], posture.axes[j], gap) == 0


def _flat(posture: Posture, joints: tuple[int, int, int]) -> bool:
    """Whether three axes are parallel to one plane."""
    i, j, k = joints
    return _volume(posture.axes[i], posture.axes[j], posture.axes[k]) == 0


def _meeting_point(posture: Posture, first: int) -> Numbers:
    """Where an axis meets the next one, which it always does."""
    return crossing(posture, first, first + 1) or posture.points[first]


def _coplanar(posture: Posture, i: int, j: int, k: int | _Place) -> bool:
    """Whether a third axis or a place lies in the plane of two parallel axes."""
    point = posture.points[k] if isinstance(k, int) else k.at(posture)
    gap = difference(posture.points[j], posture.points[i])
    return _volume(posture.axes[i], gap, difference(point, posture.points[i])) == 0


def crossing(posture: Posture, i: int, j: int) -> Numbers | None:
    """The point where two axes meet, None where they miss each other or are parallel."""
    normal = cross(posture.axes[i], posture.axes[j])
    if not any(normal) or not _meet(posture, i, j):
        return None
    # (o_i + k z_i - o_j) x z_j = 0, read in a component where z_i x z_j is not zero
    offset = cross(difference(posture.points[j], posture.points[i]), posture.axes[j])
    place = next(k for k in range(3) if normal[k])
    along = offset[place] * inverse(normal[place]) % PRIME
    x, y, z = ((o + along * a) % PRIME for o, a in zip(posture.points[i], posture.axes[i], strict=True))
    return x, y, z
