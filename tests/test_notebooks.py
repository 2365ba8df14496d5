"""The notebooks run, and show what is stored in them: texts to the letter, pictures by what is seen."""

from __future__ import annotations

import base64
import io
import json
import re
from collections.abc import Callable

import numpy as np
import pytest
from matplotlib.figure import Figure

from kinsym.live import live
from kinsym.plot import skeleton
from kinsym.robot import load
from tests.notebooks import FOLDER, ROOT, alike, cleaned, executed, names, pictures, stored, texts, tiles, written

PARTS = [
    "1_link_transforms",
    "2_forward_kinematics",
    "3_inverse_kinematics",
    "4_pieper",
    "5_successive_screws",
    "6_workspace",
    "7_generated_code",
]


def test_one_for_each_part_of_the_lecture() -> None:
    assert names() == PARTS


@pytest.mark.parametrize("name", PARTS)
def test_executed_it_is_as_stored(name: str) -> None:
    """Every text that a cell shows is the stored one, and every picture shows what the stored one shows."""
    kept, now = stored(name), executed(name)
    assert texts(now) == texts(kept), f"python -m tests.notebooks {name} stores what comes out now"
    seen, drawn = pictures(kept), pictures(now)
    assert len(seen) == len(drawn)
    assert [alike(one, other) for one, other in zip(seen, drawn, strict=True)] == [True] * len(seen)


@pytest.mark.parametrize("name", PARTS)
def test_the_file_depends_on_its_cells_alone(name: str) -> None:
    """Numbered cells, no times, no versions, no places of this machine; written as it lies there."""
    text = (FOLDER / f"{name}.ipynb").read_text(encoding="utf-8")
    notebook = stored(name)
    assert written(cleaned(notebook)) == text
    data = json.loads(text)
    assert data["metadata"]["kernelspec"]["name"] == "python3"
    code = [cell for cell in data["cells"] if cell["cell_type"] == "code"]
    assert [cell["execution_count"] for cell in code] == list(range(1, len(code) + 1))
    plain = "\n".join(texts(notebook))
    assert not re.search(rf"{re.escape(str(ROOT))}|/tmp|/home|0x[0-9a-f]{{6}}|Traceback", plain)
    assert "stderr" not in plain


@pytest.mark.parametrize("name", PARTS)
def test_a_lecturer_finds_words_equations_and_a_picture(name: str) -> None:
    """A title, sentences between the cells, mathematics of kinsym's own; numbers and a picture beside it."""
    notebook = stored(name)
    assert notebook.cells[0].source.startswith("# ")
    assert sum(cell.cell_type == "markdown" for cell in notebook.cells) >= 5
    shown = texts(notebook)
    assert any("text/markdown" in text.splitlines()[0] and "\\begin{" in text for text in shown)
    assert any("stdout" in text.splitlines()[0] for text in shown)
    assert pictures(notebook)
    assert not [text for text in shown if text.rstrip().endswith("False")]


def picture(draw: Callable[[Figure], None] | None = None, q: tuple[float, ...] = (0.5, 0.6)) -> str:
    """A picture of two links in base64, with something more in it."""
    figure = skeleton(live(load("planar_rr"), {"l1": 0.4, "l2": 0.3}), q).figure
    if draw is not None:
        draw(figure)
    file = io.BytesIO()
    figure.savefig(file, format="png")
    return base64.b64encode(file.getvalue()).decode()


def test_pictures_are_told_apart() -> None:
    """Another posture, or no arm at all, is seen; a label that moved by a dot is not."""
    kept = tiles(picture())
    assert alike(kept, tiles(picture()))

    def moved(figure: Figure) -> None:
        figure.texts[0].set_position((0.032, 0.966))

    assert picture(moved) != picture()
    assert alike(kept, tiles(picture(moved)))
    assert not alike(kept, tiles(picture(q=(0.5, 0.9))))
    assert not alike(kept, np.ones_like(kept))
    assert not alike(kept, kept[:-3])


def test_a_wrong_output_is_seen() -> None:
    """The comparison fails if a sign in a stored equation is turned."""
    kept, other = stored(PARTS[0]), stored(PARTS[0])
    output = next(
        output
        for cell in other.cells
        for output in cell.get("outputs", ())
        if "-s_{1}" in output.get("data", {}).get("text/markdown", "")
    )
    output.data["text/markdown"] = output.data["text/markdown"].replace("-s_{1}", "s_{1}")
    assert texts(kept) != texts(other)
