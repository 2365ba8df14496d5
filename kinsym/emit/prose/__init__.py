"""What the terminal and LaTeX share: words for tasks and steps, names that occur, line breaks in formulas."""
