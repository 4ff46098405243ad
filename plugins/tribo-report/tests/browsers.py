"""Real browsers without a window, driven by WebDriver BiDi."""

import json
import shutil
import socket
import subprocess
import tempfile
import time
import urllib.request
from contextlib import ExitStack, contextmanager
from itertools import count

import pytest

websocket = pytest.importorskip("websocket")

QUIET = (
    "--headless",
    "--no-sandbox",
    "--disable-dev-shm-usage",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    # WebGL without a graphics card.
    "--enable-unsafe-swiftshader",
)
PATIENCE = 60.0


class Page:
    """A tab, with what its console said and what it asked the network for."""

    def __init__(self, connection, begins):
        self._connection, self._numbers = connection, count(1)
        self.console, self.requests = [], []
        if begins:
            self.ask("session.new", capabilities={})
        self.context = self.ask("browsingContext.getTree")["contexts"][0]["context"]
        self.ask("session.subscribe", events=["log.entryAdded", "network.beforeRequestSent"])

    def ask(self, method, **parameters):
        number = next(self._numbers)
        sent = {"id": number, "method": method, "params": parameters}
        self._connection.send(json.dumps(sent))
        while (answer := json.loads(self._connection.recv())).get("id") != number:
            self._note(answer)
        assert answer["type"] == "success", answer
        return answer["result"]

    def _note(self, event):
        if event.get("method") == "log.entryAdded" and event["params"]["level"] in (
            "error",
            "warn",
        ):
            self.console.append(event["params"]["text"])
        elif event.get("method") == "network.beforeRequestSent":
            self.requests.append(event["params"]["request"]["url"])

    def open(self, url, width=1400, height=900):
        size = {"width": width, "height": height}
        self.ask("browsingContext.setViewport", context=self.context, viewport=size)
        self.ask("browsingContext.navigate", context=self.context, url=url, wait="complete")

    def run(self, script):
        """Return what a JavaScript expression, or a promise, comes to, by way of JSON."""
        found = self.ask(
            "script.evaluate",
            expression=f"Promise.resolve({script}).then(JSON.stringify)",
            target={"context": self.context},
            awaitPromise=True,
        )
        assert found["type"] == "success", found["exceptionDetails"]["text"]
        value = found["result"].get("value")
        return None if value is None else json.loads(value)

    def wait(self, condition):
        until = time.monotonic() + PATIENCE
        while not self.run(f"Boolean({condition})"):
            assert time.monotonic() < until, f"{condition} never held; console: {self.console}"
            time.sleep(0.1)

    def press(self, key, times=1):
        strokes = [{"type": kind, "value": key} for kind in ("keyDown", "keyUp")] * times
        keys = {"type": "key", "id": "keys", "actions": strokes}
        self.ask("input.performActions", context=self.context, actions=[keys])


PROGRAMS = {
    "chromium": [("chromium", "chromium-browser", "google-chrome"), ("chromedriver",)],
    "firefox": [("firefox-esr", "firefox")],
}
"""Names of what each browser needs."""


def _programs(name):
    return [next(filter(None, map(shutil.which, names)), None) for names in PROGRAMS[name]]


def missing(name):
    """Return what a browser lacks here; empty if it can be driven."""
    found = zip(PROGRAMS[name], _programs(name), strict=True)
    lacking = [names[0] for names, program in found if program is None]
    return f"{', '.join(lacking)} not found" if lacking else ""


@contextmanager
def browser(name):
    """Start a browser with a profile of its own, and yield its page."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    with ExitStack() as stack:
        profile = stack.enter_context(tempfile.TemporaryDirectory(ignore_cleanup_errors=True))
        command = [_programs(name)[-1]]
        if name == "chromium":
            command += [f"--port={port}"]
        else:
            command += ["--headless", "--profile", profile, "--no-remote"]
            command += [f"--remote-debugging-port={port}"]
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        process = stack.enter_context(subprocess.Popen(command, **quiet))
        stack.callback(process.terminate)
        connection = _connected(name, port, profile)
        stack.callback(connection.close)
        page = Page(connection, begins=name == "firefox")
        yield page
        page.ask("browser.close")


def _connected(name, port, profile):
    until = time.monotonic() + PATIENCE
    while True:
        try:
            url = f"ws://127.0.0.1:{port}/session"
            if name == "chromium":
                url = _session(port, profile)
            return websocket.create_connection(url, timeout=PATIENCE, suppress_origin=True)
        except (OSError, websocket.WebSocketException):
            if time.monotonic() > until:
                raise
            time.sleep(0.2)


def _session(port, profile):
    """Return the address of a session that chromedriver opens."""
    binary, _ = _programs("chromium")
    chrome = {"binary": binary, "args": [*QUIET, f"--user-data-dir={profile}"]}
    wanted = {"capabilities": {"alwaysMatch": {"webSocketUrl": True, "goog:chromeOptions": chrome}}}
    request = urllib.request.Request(
        f"http://127.0.0.1:{port}/session",
        json.dumps(wanted).encode(),
        {"Content-Type": "application/json"},
    )
    with urllib.request.urlopen(request, timeout=PATIENCE) as answer:
        return json.load(answer)["value"]["capabilities"]["webSocketUrl"]
