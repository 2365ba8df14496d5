"""Pictures of arms and of workspaces, drawn with matplotlib (``pip install 'kinsym[plot]'``).

Each function draws into the axes it is given, or makes a figure of its own, and returns the axes; nothing here keeps a
state or opens a window. Arms that move in a plane are drawn in the plane, others in space.

    >>> from kinsym.live import live
    >>> from kinsym.plot import skeleton
    >>> from kinsym.robot import load
    >>> axes = skeleton(live(load("planar_rr"), {"l1": 0.4, "l2": 0.3}), [0.5, 0.7])
    >>> axes.get_xlabel()
    'x'
"""

from kinsym.plot.branches import branches
from kinsym.plot.export import PICTURES, plain_style, rendered
from kinsym.plot.skeleton import skeleton
from kinsym.plot.workspace import workspace

__all__ = ["PICTURES", "branches", "plain_style", "rendered", "skeleton", "workspace"]
