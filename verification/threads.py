"""One thread for linear algebra, set before numpy is loaded: import this first, and from a command only.

The studies solve many small systems; threads that wait for each other there cost more than they bring (measured: the
quick level takes 1.5 times as long with two). A value already in the environment is kept.
"""

import os

os.environ.setdefault("OMP_NUM_THREADS", "1")
