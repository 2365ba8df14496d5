"""A million poses a robot, most of them next to singular ones and at borders: ``python -m tests.stress``."""
