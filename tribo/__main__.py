"""``python -m tribo`` is the `tribo` command."""

import sys

# Python puts the folder that it was started in before its own library.
if not sys.flags.safe_path:
    del sys.path[0]

from tribo.cli.main import main

main()
