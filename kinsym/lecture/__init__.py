"""The lecture that kinsym follows, equation by equation, against kinsym's own derivations.

H. D. Taghirad, Robotics: Mechanics & Control, chapter 3: Kinematic Analysis. ``equations/`` holds every equation as it
is printed; whether it is true, and whether kinsym prints it in the same form, is decided here and written nowhere.
"""

from kinsym.lecture.chapter import Chapter, Entry, chapters
from kinsym.lecture.verdict import Verdict, verdicts

__all__ = ["Chapter", "Entry", "Verdict", "chapters", "verdicts"]
