"""The derivation as a LaTeX document."""

from kinsym.emit.latex.document import document, fragment

__all__ = ["document", "fragment"]
