"""Ctrl-C ends a command, whenever it comes."""

import subprocess
import sys
import textwrap

SCRIPT = """
    import signal, time, weakref
    from unittest import mock
    import tribo.cli.main as cli

    # A shell starts what runs in the background with the signal ignored.
    signal.signal(signal.SIGINT, signal.default_int_handler)

    class Thing:
        pass

    def work(**options):
        thing = Thing()
        kept = weakref.ref(thing, lambda _: signal.raise_signal(signal.SIGINT))
        del thing
        for _ in range(500):
            time.sleep(0.01)

    with mock.patch.object(cli.tribo, "main", work):
        try:
            cli.main()
        except KeyboardInterrupt:
            print("stopped")
"""


def test_one_that_comes_while_python_tidies_up_is_not_lost():
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(SCRIPT)],
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "stopped\n", "")
