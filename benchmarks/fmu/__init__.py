"""Cost of the calls of an FMU: native build, Python build, and a minimal FMU written by hand in C."""
