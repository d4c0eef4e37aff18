"""The command line, as ``python -m fmu_bearing`` and as the command ``fmu-bearing``."""

import sys


def main() -> None:
    """Run the command; Ctrl-C ends it with one line at any time, while modules are loaded too."""
    try:
        from fmu_bearing.cli import app

        app(prog_name="fmu-bearing")
    except KeyboardInterrupt:
        sys.stderr.write("interrupted\n")
        sys.exit(130)


if __name__ == "__main__":
    main()
