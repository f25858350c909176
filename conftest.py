"""What holds for all tests: one thread for linear algebra.

The matrices here are small, and the tests run in as many processes as there are cores already.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("OMP_NUM_THREADS", "1")
