"""The laws on ever new random arms: ``python -m tests.laws --minutes 10``.

Laws take turns, each with a fresh seed. A law that is broken is told with the smallest arm that breaks it, which then
belongs into a test of its own, and the command ends with status 1.
"""

from __future__ import annotations

import argparse
import sys
import time
import traceback
from collections import Counter
from itertools import count

import numpy as np
from hypothesis import HealthCheck, given, seed, settings
from hypothesis import strategies as st

from tests.laws.laws import LAWS
from tests.laws.robots import tables
from tests.laws.tables import Table

EXAMPLES = 10


def keeps(law: str, target: str, start: int) -> tuple[int, str]:
    """How many arms were tried, and what is to be said of one that breaks the law, empty if none does."""
    tried = 0

    @seed(start)
    @settings(max_examples=EXAMPLES, deadline=None, database=None, suppress_health_check=list(HealthCheck))
    @given(table=tables(), number=st.integers(0, 999))
    def run(table: Table, number: int) -> None:
        nonlocal tried
        tried += 1
        LAWS[law](table, target, np.random.default_rng(number))

    try:
        run()
    except Exception as error:  # whatever kinsym raises on an arm of these classes breaks the law
        return tried, "\n".join([*traceback.format_exception(error, limit=-3), *getattr(error, "__notes__", ())])
    return tried, ""


def main() -> int:
    """Read the options, run, and tell how many arms kept each law."""
    parser = argparse.ArgumentParser(prog="python -m tests.laws", description=__doc__)
    parser.add_argument("--minutes", type=float, default=10.0, help="how long (default: 10)")
    parser.add_argument("--law", action="append", choices=list(LAWS), help="this law alone; may be repeated")
    parser.add_argument("--target", choices=["numpy", "c"], default="numpy", help="the generated code that is asked")
    parser.add_argument("--seed", type=int, default=0, help="where the seeds begin (default: 0)")
    options = parser.parse_args()
    end, arms, broken = time.monotonic() + 60.0 * options.minutes, Counter[str](), Counter[str]()
    laws = options.law or list(LAWS)
    for start in count(options.seed):
        for law in laws:
            if time.monotonic() > end:
                break
            tried, said = keeps(law, options.target, start)
            arms[law] += tried
            if said:
                broken[law] += 1
                print(f"{law}, seed {start}:\n{said}\n", flush=True)
        else:
            continue
        break
    for law in laws:
        print(f"{law:13} {arms[law]:6} arms, {'kept' if not broken[law] else f'broken in {broken[law]} runs'}")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
