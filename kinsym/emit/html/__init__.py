"""A derivation as a part of a web page: formulas in MathML, sentences and tables in HTML."""

from kinsym.emit.html.derivation import derivation_html

__all__ = ["derivation_html"]
