"""The case as a drawing: two bodies, the load and the motion, not to scale."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from html import escape
from typing import Any

from tribo_report.amounts import component

WIDTH, HEIGHT = 520, 320
MIDDLE, CONTACT = 260, 160
"""Where the bodies touch, from the left and from the top."""
CURVED = ("sphere", "paraboloid")


def drawing(case: Mapping[str, Any], swept: str | None, load: str) -> str:
    """Return the case as SVG. Its stationary body is above, or the first."""
    bodies: Mapping[str, Any] = case["bodies"]
    lower = list(bodies)[-1] if swept is None else swept
    upper = next(name for name in bodies if name != lower)
    shapes = {name: _shape(body.get("surface") or {}) for name, body in bodies.items()}
    coated = {name: bool(body.get("layers")) for name, body in bodies.items()}
    called = {name: f"coated {name}" if coated[name] else name for name in bodies}
    motion = str(case["kinematics"].get("type", "motion"))
    both = getattr(component(case["kinematics"]), "turns_back", False)
    parts = [
        *_body(shapes[lower], coated[lower], up=False),
        *_body(shapes[upper], coated[upper], up=True),
        _text(MIDDLE, CONTACT - 40, called[upper]),
        _text(MIDDLE, CONTACT + 46, called[lower]),
        # The load from above, the motion of what lies below.
        _arrow(MIDDLE, 16, MIDDLE, 76, both=False),
        _text(MIDDLE + 12, 40, load, "start"),
        _arrow(MIDDLE - 90, HEIGHT - 60, MIDDLE + 90, HEIGHT - 60, both=both),
        _text(MIDDLE, HEIGHT - 34, motion),
    ]
    words = (
        f"Drawing of the case, not to scale: {called[upper]} on {called[lower]}, pressed by "
        f"{load}; {motion}"
    )
    return (
        f'<svg class="case" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{escape(words)}">'
        '<defs><marker id="head" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" '
        'markerHeight="7" orient="auto-start-reverse"><path d="M0 0 8 4 0 8z"/></marker></defs>'
        f"{''.join(parts)}</svg>"
    )


def _shape(surface: Mapping[str, Any]) -> tuple[str, bool]:
    """Return the outline of a surface seen along y, and whether it is rough."""
    rough = False
    while isinstance(surface.get("on"), Mapping):
        surface, rough = surface["on"], True
    name = surface.get("type", "")
    if name in CURVED or (name == "cylinder" and surface.get("axis", "y") == "y"):
        return "round", rough
    return ("pin" if name == "pin" else "flat"), rough


def _body(shape: tuple[str, bool], coated: bool, *, up: bool) -> Iterator[str]:
    """Draw a body above the contact or, mirrored, below it."""
    kind, rough = shape
    top, name, mirror = CONTACT - 80, "upper", ""
    if not up:
        name, mirror = "lower", f' transform="translate(0 {2 * CONTACT}) scale(1 -1)"'
    # An arc of radius 130 over a chord of 240 is 80 high.
    left, right = {"round": (140, 380), "pin": (190, 330)}.get(
        kind, (100, 420) if up else (50, 470)
    )
    face = f"V{CONTACT}H{right}V{top}"
    if kind == "round":
        face = f"A130 130 0 0 0 {right} {top}"
    yield f'<g{mirror}><path class="{name}" d="M{left} {top}{face}Z"/>'
    if coated:
        yield f'<path class="coat" d="M{left} {top}{face}"/>'
    if rough:
        yield f'<path class="rough" d="M{left} {top}{face}"/>'
    yield "</g>"


def _arrow(x1: float, y1: float, x2: float, y2: float, *, both: bool) -> str:
    start = ' marker-start="url(#head)"' if both else ""
    return f'<path class="arrow" d="M{x1} {y1}L{x2} {y2}" marker-end="url(#head)"{start}/>'


def _text(x: float, y: float, words: str, anchor: str = "middle") -> str:
    return f'<text x="{x}" y="{y}" text-anchor="{anchor}">{escape(words)}</text>'
