"""Colours and measures of all pictures, in one place.

The colours are those of Okabe and Ito (Color Universal Design, 2008), which people with any common kind of colour
blindness tell apart.
"""

from __future__ import annotations

X, Y, Z = "#d55e00", "#009e73", "#0072b2"
"""The axes of frames: x vermilion, y bluish green, z blue."""
LINK, TURN, SLIDE, ROD = "#b8c0ca", "#3d4a5c", "#e69f00", "#f0d9a0"
"""Links, turning joints, sliding joints, and what a sliding joint draws out."""
INK, FAINT, SHADOW, PANE = "#22272e", "#8b949e", "#dfe3e8", "#fbfcfd"
"""Writing, joint axes, the shadow on the floor, the walls behind."""
BRANCHES = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#5b5b5b", "#a6761d")
"""Arms drawn over each other, again from the beginning if there are more."""
SHARED = "#8b949e"
"""What several of these arms have in common."""

WIDTH, HEIGHT, DPI = 8.0, 6.4, 100
"""A picture in inches, and dots an inch: 800 dots wide."""
TITLE, LABEL, SMALL = 13.0, 10.0, 9.0
"""Sizes of writing in points."""

RADIUS = 0.017
"""Half the thickness of a link, a share of the picture's extent; all that follows are as well."""
JOINT_RADIUS, JOINT_LENGTH = 0.034, 0.095
SLIDE_WIDTH, SLIDE_LENGTH, ROD_WIDTH = 0.064, 0.12, 0.022
NAME_AWAY = 0.085
"""How far the name of a joint is from its middle."""
FRAME_LENGTH, END_LENGTH, ARROW = 0.085, 0.13, 0.0055
"""Axes of the frames between, of the base's and the tool's, and half their thickness."""
