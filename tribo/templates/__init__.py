"""Cases to start from."""

from __future__ import annotations

from importlib.resources import files

TEMPLATES = {
    "ball_on_disk": "The paper's one-hour ball-on-disk test.",
    "weighed_split": "The same with the loss that was weighed, ten times more on the ball.",
    "pin_on_disk": "A ball on a turning disk, as in ASTM G99.",
    "ball_on_flat": "A ball that reciprocates on a flat, as in ASTM G133.",
    "flat_pin": "A flat-ended pin on a turning disk.",
    "line_contact": "A roller that reciprocates on a plate.",
    "block_on_ring": "A block on a turning ring, as in ASTM G77.",
    "fretting": "A cylinder that frets on a flat in gross slip.",
    "duty_cycle": "A ball under a load that changes over time.",
    "coated_ball": "A ball whose hard coating is worn through.",
    "rough_ball": "A rough ball that runs in on a smooth disk.",
    "rough_flats": "A patch of two rough bodies that repeats.",
}


def template(name: str) -> str:
    """Return the text of a template; `name` is a key of `TEMPLATES`."""
    return files("tribo.templates").joinpath(f"{name}.toml").read_text(encoding="utf-8")
