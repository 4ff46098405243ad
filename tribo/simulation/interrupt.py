"""Let Ctrl-C end a run between two steps instead of inside one."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType


@contextmanager
def interrupts_held() -> Iterator[threading.Event]:
    """Yield an event that SIGINT and SIGTERM set meanwhile; a second signal is not held back."""
    requested = threading.Event()

    def request(number: int, frame: FrameType | None) -> None:
        if requested.is_set():
            raise KeyboardInterrupt
        requested.set()

    # Python lets only the main thread handle signals.
    main = threading.current_thread() is threading.main_thread()
    held = (signal.SIGINT, signal.SIGTERM) if main else ()
    before = {number: signal.signal(number, request) for number in held}
    try:
        yield requested
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
