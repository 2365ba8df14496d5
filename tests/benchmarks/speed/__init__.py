"""How fast the generated code is, beside other libraries on the same poses, in one run on one core.

``__main__`` has the command, ``groups`` what is compared, ``native`` and ``own`` the programs, ``peers/`` a file a
library, ``worker`` the clock, ``judge`` the answers' closure, ``page`` the tables, ``plot`` the picture.
"""
