"""A bar chart in SVG: the time of all solutions of one pose, on a logarithmic scale, from C and from Python."""

from __future__ import annotations

import math
from collections.abc import Sequence
from html import escape

WIDTH, LABEL, BAR, GAP, HEAD = 760, 250, 16, 5, 34
OWN, OTHER = "#1f6f8b", "#c9c4b8"


def chart(sections: Sequence[tuple[str, Sequence[tuple[str, float]]]]) -> str:
    """Sections of (name, nanoseconds); those whose name begins with kinsym stand out."""
    values = [value for _, bars in sections for _, value in bars]
    low = 10 ** math.floor(math.log10(min(values)))
    high = 10 ** math.ceil(math.log10(max(values)))
    room = WIDTH - LABEL - 90

    def place(value: float) -> float:
        return room * math.log10(value / low) / math.log10(high / low)

    height, parts = 10, []
    for title, bars in sections:
        parts.append(f'<text x="8" y="{height + 18}" font-weight="bold">{escape(title)}</text>')
        height += HEAD
        for name, value in sorted(bars, key=lambda bar: bar[1]):
            middle = height + BAR - 4
            colour = OWN if name.startswith("kinsym") else OTHER
            length = max(place(value), 1.0)
            parts.append(f'<text x="{LABEL - 8}" y="{middle}" text-anchor="end">{escape(name)}</text>')
            parts.append(f'<rect x="{LABEL}" y="{height}" width="{length:.1f}" height="{BAR}" fill="{colour}"/>')
            parts.append(f'<text x="{LABEL + length + 6:.1f}" y="{middle}">{_spoken(value)}</text>')
            height += BAR + GAP
        height += GAP
    body = "\n".join(parts)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" '
        'font-family="sans-serif" font-size="13">\n'
        f'<rect width="{WIDTH}" height="{height}" fill="#ffffff"/>\n{body}\n</svg>\n'
    )


def _spoken(nanoseconds: float) -> str:
    """A time with its unit.

    >>> _spoken(152.3), _spoken(2761.0), _spoken(3.4e5)
    ('152 ns', '2.76 µs', '340 µs')
    """
    return f"{nanoseconds:.0f} ns" if nanoseconds < 1000 else f"{nanoseconds / 1000:.3g} µs"
