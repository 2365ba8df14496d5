"""kinsym's own mathematics broken on purpose, change by change: do its tests see it? ``python -m tests.mutation``."""
