"""What the calls of an FMU cost: native build, Python build, and a minimal FMU written by hand in C."""
