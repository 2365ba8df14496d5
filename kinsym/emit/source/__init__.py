"""Source code: the schedule printed as NumPy and as C, through templates."""
