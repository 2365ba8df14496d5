"""Generated code broken on purpose, change by change: does ``kinsym check`` see it? ``python -m tests.sabotage``."""
