"""The derivation as a LaTeX document."""

from kinsym.emit.latex.document import document

__all__ = ["document"]
