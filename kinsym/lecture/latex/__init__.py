"""The whole lecture as one LaTeX document, every system of it with its derivation."""

from kinsym.lecture.latex.chapter_document import chapter_document

__all__ = ["chapter_document"]
