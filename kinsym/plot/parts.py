"""The parts that a picture of an arm is made of, and which of them several arms have in common."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from kinsym.plot import style

if TYPE_CHECKING:
    from kinsym.live import Floats
    from kinsym.skeleton import Linkage, Posture

LINK, ROD, TURN, SLIDE = "link", "rod", "turn", "slide"
COLOURS = {LINK: style.LINK, ROD: style.ROD, TURN: style.TURN, SLIDE: style.SLIDE}
_PLACES = 5


@dataclass(frozen=True)
class Part:
    """A link or what a sliding joint draws out, from ``start`` to ``end``, or a joint along the way between them.

    ``frame`` (4, 4) is that of the joint that it belongs to, its z axis along the joint's. ``corner`` says that
    no joint hides the end of a link.
    """

    kind: str
    start: Floats
    end: Floats
    frame: Floats
    corner: bool = False

    def key(self, size: float) -> tuple[str | float, ...]:
        """The same for parts that lie on each other in a picture of some extent."""
        places = np.round(np.concatenate([self.start, self.end]) / size, _PLACES) + 0.0
        return self.kind, *places.tolist()


def parts(shape: Linkage, posture: Posture, size: float) -> Iterator[Part]:
    """The parts of an arm at one posture, in a picture of some extent: links first, then joints."""
    path, joints = posture.path, posture.joints
    middles = joints[:, :3, 3]
    for k, (start, end) in enumerate(pairwise(path)):
        if not (end - start).any():
            continue
        joint = min(k // 2, len(joints) - 1)
        along = k % 2 == 1 and k < len(path) - 2
        hidden = np.linalg.norm(middles - end, axis=-1).min() < style.RADIUS * size
        kind = ROD if along and shape.kinds[joint] == "P" else LINK
        yield Part(kind, start, end, joints[joint], corner=not hidden)
    for kind, frame in zip(shape.kinds, joints, strict=True):
        long = style.SLIDE_LENGTH if kind == "P" else style.JOINT_LENGTH
        half = long * size / 2.0 * frame[:3, 2]
        yield Part(SLIDE if kind == "P" else TURN, frame[:3, 3] - half, frame[:3, 3] + half, frame)


def painted(arms: Sequence[Sequence[Part]], colours: Sequence[str], size: float) -> Iterator[tuple[Part, str]]:
    """The parts of several arms with the arm's colour, those that are shared once and in a colour of none of them."""
    count = Counter(part.key(size) for arm in arms for part in arm)
    done = set()
    for arm, colour in zip(arms, colours, strict=True):
        for part in arm:
            key = part.key(size)
            if key not in done:
                yield part, colour if count[key] == 1 else style.SHARED
            done.add(key)
