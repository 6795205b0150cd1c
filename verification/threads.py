"""One thread for linear algebra, set before NumPy is loaded. Import this first, and from a command only.

The studies solve many small systems. Threads that wait for each other there cost more than they bring: the quick level
takes 1.5 times as long with two. A value that is already in the environment is kept.
"""

import os

os.environ.setdefault("OMP_NUM_THREADS", "1")
