"""The command line as ``python -m fmu_bearing``."""

from fmu_bearing.cli import app

app(prog_name="fmu-bearing")
