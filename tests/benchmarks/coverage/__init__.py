"""Coverage: which arms are solved, how completely and how exactly, against oracles that know nothing of kinsym.

``python -m tests.benchmarks.coverage`` prints the table, ``--write`` puts it into ``docs/coverage.md``.
"""
