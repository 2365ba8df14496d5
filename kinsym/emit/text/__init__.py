"""The derivation in plain text, for a terminal."""

from kinsym.emit.text.equations import equations

__all__ = ["equations"]
