"""What every component must fulfil, besides answering."""

from __future__ import annotations

from collections.abc import Mapping

from tribo.testing.subject import Check, Subject, fact, require


@fact
def facts_are_text_and_stay(subject: Subject) -> None:
    """What it states of itself is text by text, and the same each time it is asked."""
    component = subject.make()
    stated = component.facts()
    require(isinstance(stated, Mapping), f"facts() gave a {type(stated).__name__}; give a mapping")
    for name, text in stated.items():
        require(
            isinstance(name, str) and isinstance(text, str),
            f"facts() holds {name!r}: {text!r}; write both as text",
        )
    before = dict(stated)
    for when, again in (("asked again", component), ("asked of a new object", subject.make())):
        later = dict(again.facts())
        require(later == before, f"facts() gave {before}, and {later} when {when}")


COMPONENT_CHECKS: tuple[Check, ...] = (facts_are_text_and_stay,)
