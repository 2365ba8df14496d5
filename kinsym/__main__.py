"""``python -m kinsym`` is the console script ``kinsym``."""

from __future__ import annotations

import sys

from kinsym.cli import main

if __name__ == "__main__":
    sys.exit(main())
