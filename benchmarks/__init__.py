"""Simulated seconds per wall second, error and cost of each fidelity, beside its peers."""

import os

# One thread for everybody's linear algebra; read when NumPy, SciPy and SUNDIALS are loaded, so set before.
os.environ["OPENBLAS_NUM_THREADS"] = "1"
