"""``python -m tribo`` is the `tribo` command."""

from tribo.cli.main import main

main()
