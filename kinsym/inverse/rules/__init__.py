"""The rules, one file a shape of equation; the search asks each of them for candidates."""

from __future__ import annotations

from kinsym.inverse.rules import homogeneous, lengths, linear, sine_cosine, square_and_add, triangle

RULES = (sine_cosine, lengths, homogeneous, triangle, linear)
"""In order of preference; the cost of a candidate decides."""

LAST_RULES = (square_and_add,)
"""Rules that are dearer than all others, and take longer to look."""

TITLES: dict[str, str] = {key: title for rule in (*RULES, *LAST_RULES) for key, title in rule.TITLES.items()}
"""What a reader calls each rule."""
