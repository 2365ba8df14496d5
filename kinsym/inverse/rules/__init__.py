"""The rules, one file a shape of equation; the search asks each of them for candidates."""

from __future__ import annotations

from kinsym.inverse.rules import homogeneous, lengths, linear, sine_cosine, triangle

RULES = (sine_cosine, lengths, homogeneous, triangle, linear)
"""In order of preference; the cost of a candidate decides."""

TITLES: dict[str, str] = {key: title for rule in RULES for key, title in rule.TITLES.items()}
"""What a reader calls each rule."""
