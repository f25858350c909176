"""Start the command line with ``python -m swayless``."""

from swayless.cli.app import main

main()
