"""kinsym from Python: the functions and results that ``import kinsym`` offers."""
