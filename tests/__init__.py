"""Tests and benchmarks."""

import os

# As in the program: threads within small matrices only wait for each other.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
