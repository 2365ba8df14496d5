"""A picture as the bytes of a file, the same at every run with the same matplotlib."""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import matplotlib

PICTURES = ("png", "svg")
_SALT = "kinsym"


def rendered(ax: Any, kind: str) -> bytes:
    """The figure of some axes as the bytes of a ``png`` or an ``svg``."""
    file = io.BytesIO()
    metadata = {"Date": None, "Creator": None} if kind == "svg" else {"Software": None}
    with matplotlib.rc_context({"svg.hashsalt": _SALT, "svg.fonttype": "path"}):
        ax.figure.savefig(file, format=kind, metadata=metadata, facecolor="white")
    return file.getvalue()


@contextmanager
def plain_style() -> Iterator[None]:
    """Matplotlib's own settings while a picture is made, whatever a ``matplotlibrc`` of the user says."""
    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        yield
