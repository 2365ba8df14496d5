"""Whether two pictures of ``kinsym plot`` show the same.

Letters may differ by a hair from one matplotlib to the next; what is written and where the arms are may not.
"""

from __future__ import annotations

import re

import numpy as np


def same_picture(committed: str, drawn: str) -> bool:
    """Whether the SVG files hold the same words and the same bodies, these to a hundredth of a point."""
    if re.findall("<!-- (.*) -->", drawn) != re.findall("<!-- (.*) -->", committed):
        return False
    before, after = facets(committed), facets(drawn)
    return [len(facet) for facet in before] == [len(facet) for facet in after] and all(
        np.allclose(one, other, atol=0.01) for one, other in zip(before, after, strict=True)
    )


def facets(svg: str) -> list[list[float]]:
    """The corners of all facets of the arms; of a picture in the plane, of everything that is no letter."""
    bodies = re.findall(r'<g id="bodies">(.*?)</g>', svg, re.DOTALL)
    drawn = bodies or [re.sub(r"<defs>.*?</defs>", "", svg, flags=re.DOTALL)]
    paths = [path for part in drawn for path in re.findall(r'<path\b[^>]*? d="([^"]*)"', part)]
    return [[float(number) for number in re.findall(r"-?[\d.]+", path)] for path in paths]
