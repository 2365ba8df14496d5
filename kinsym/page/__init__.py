"""A robot's kinematics as one page that opens from disk: equations, a drawing that moves, checks and code."""

from kinsym.page.document import page

__all__ = ["page"]
