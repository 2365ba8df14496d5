"""Exact arithmetic: the ring of an arm, evaluation in a prime field, and expressions as they are printed."""
