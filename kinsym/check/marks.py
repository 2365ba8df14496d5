"""What the exact walk knows of a root beside its value."""

from __future__ import annotations

from enum import IntFlag


class Mark(IntFlag):
    """How special the root of one step is."""

    #: Every value solves the equation; the reference chose.
    FREE = 1
    #: Two roots meet in this one.
    BORDER = 2
    #: So near to one of these that its last digits are lost.
    SOFT = 4
    #: The equation has no root, but comes near to one, or may come near when what was chosen before moves.
    DOUBTFUL = 8


NONE = Mark(0)

#: How far beside a special pose a root is marked, in tolerances of its equation: with the tolerance 2^-46, a millionth.
NEAR = 2**26
