"""Geometry of a robot in numbers of 40 digits: where its axes lie at home, and the table that leads along them."""
