"""Cases to start from."""

from __future__ import annotations

from importlib.resources import files

TEMPLATES = {
    "ball_on_disk": "The paper's one-hour ball-on-disk test.",
    "weighed_split": "The same with the loss that was weighed, ten times more on the ball.",
    "pin_on_disk": "A ball on a turning disk, as in ASTM G99.",
}


def template(name: str) -> str:
    """Return the text of a template; `name` is a key of `TEMPLATES`."""
    return files("tribo.templates").joinpath(f"{name}.toml").read_text(encoding="utf-8")
