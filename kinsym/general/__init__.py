"""Six joints without a closed form: one angle from a polynomial of degree 16, the others from linear equations."""
