"""kinsym: closed-form kinematics of serial robots, as formulas and as source code.

Importing the package is quick on purpose: SymPy is loaded by the parts that calculate, when they are used.
"""

from __future__ import annotations

__version__ = "0.1.0"
