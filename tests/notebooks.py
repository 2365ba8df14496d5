"""The notebooks, executed: ``python -m tests.notebooks [NAME ...]`` runs them and stores what comes out.

A notebook holds what depends on its cells alone: no times, no versions, no paths, and ids that are its cells' numbers.
Executed twice with the same libraries it is the same file; with others its pictures may differ by some dots.
"""

from __future__ import annotations

import base64
import io
import os
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import matplotlib.font_manager  # noqa: F401 - collects the fonts, which a kernel would tell about
import nbformat
import numpy as np
from matplotlib.image import imread
from nbclient import NotebookClient

ROOT = Path(__file__).resolve().parent.parent
FOLDER = ROOT / "notebooks"
SECONDS = 120
PICTURES = ("image/png",)
_METADATA = {
    "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
    "language_info": {"name": "python"},
}
_TILE = 20
"""Pictures are compared by the means of tiles of so many dots, which outlive another version of a font."""


def names() -> list[str]:
    """The notebooks in their order."""
    return sorted(path.stem for path in FOLDER.glob("*.ipynb"))


def stored(name: str) -> Any:
    """A notebook as it lies in the folder."""
    return nbformat.read(FOLDER / f"{name}.ipynb", as_version=4)


def executed(name: str) -> Any:
    """A notebook run from top to bottom in a kernel of its own; CellExecutionError if a cell raises."""
    notebook = stored(name)
    for cell in notebook.cells:
        if cell.cell_type == "code":
            cell.outputs, cell.execution_count = [], None
    with tempfile.TemporaryDirectory(prefix="kinsym-notebook-") as home:
        # The user's settings of IPython and matplotlib stay out, and so does the user's history.
        Path(home, "matplotlibrc").touch()
        environment = {
            **os.environ,
            "IPYTHONDIR": home,
            "JUPYTER_PLATFORM_DIRS": "1",
            "PYDEVD_DISABLE_FILE_VALIDATION": "1",
            "PYTHONPATH": str(ROOT),
        }
        client = NotebookClient(
            notebook,
            timeout=SECONDS,
            kernel_name="python3",
            record_timing=False,
            extra_arguments=["--log-level=ERROR"],
            resources={"metadata": {"path": home}},
        )
        client.execute(env=environment)
    return cleaned(notebook)


def cleaned(notebook: Any) -> Any:
    """The notebook without anything that depends on when, where and by what it was run."""
    notebook.metadata = nbformat.from_dict(_METADATA)
    notebook.nbformat, notebook.nbformat_minor = 4, 5
    for number, cell in enumerate(notebook.cells, start=1):
        cell.id, cell.metadata = f"cell-{number}", {}
        for output in cell.get("outputs", ()):
            if "metadata" in output:
                output.metadata = {}
            for kind in PICTURES:
                if kind in output.get("data", {}):
                    output.data["text/plain"] = "<Figure>"
    return notebook


def written(notebook: Any) -> str:
    """The file of a notebook."""
    return nbformat.writes(notebook, indent=1, ensure_ascii=False) + "\n"


def texts(notebook: Any) -> list[str]:
    """All that the cells print and show but pictures, one entry an output, each under its cell's number."""
    return [f"cell {number}: {kind}\n{text}" for number, kind, text in _outputs(notebook) if kind not in PICTURES]


def pictures(notebook: Any) -> list[np.ndarray]:
    """The pictures that the cells show, in order, each as the mean brightness of its tiles."""
    return [tiles(text) for _, kind, text in _outputs(notebook) if kind in PICTURES]


def tiles(png: str) -> np.ndarray:
    """The mean brightness of the tiles of a picture in base64, from 0 to 1."""
    grey = imread(io.BytesIO(base64.b64decode(png)))[..., :3].mean(axis=-1)
    rows, columns = (length // _TILE for length in grey.shape)
    cut = grey[: rows * _TILE, : columns * _TILE].reshape(rows, _TILE, columns, _TILE)
    means: np.ndarray = cut.mean(axis=(1, 3))
    return means


def alike(one: np.ndarray, other: np.ndarray) -> bool:
    """Whether two pictures show the same: of nearly the same size, and but for a few tiles equally bright."""
    if max(abs(a - b) for a, b in zip(one.shape, other.shape, strict=True)) > 1:
        return False
    rows, columns = (min(a, b) for a, b in zip(one.shape, other.shape, strict=True))
    apart = np.abs(one[:rows, :columns] - other[:rows, :columns])
    return bool(np.mean(apart > 0.1) < 0.01)


def _outputs(notebook: Any) -> Iterator[tuple[int, str, str]]:
    for number, cell in enumerate(notebook.cells, start=1):
        for output in cell.get("outputs", ()):
            if output.output_type == "stream":
                yield number, output.name, output.text
            else:
                yield from ((number, kind, text) for kind, text in sorted(output.data.items()))


def main(wanted: list[str]) -> None:
    """Execute the notebooks that are named, or all, and store them."""
    for name in wanted or names():
        text = written(executed(name))
        (FOLDER / f"{name}.ipynb").write_text(text, encoding="utf-8", newline="\n")
        print(f"{name}: {len(text) // 1024} KiB")


if __name__ == "__main__":
    main(sys.argv[1:])
