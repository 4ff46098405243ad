"""Each mistake in a case is one line with its path and a remedy, in the words of the case."""

import dummies_in_tables as dummies
import pytest
from pydantic import ValidationError

from tribo import CaseError, Load
from tribo.core.explain import case_error

STEEL = {"young": "207 GPa", "poisson": 0.3}
LINEAR = {"type": "linear", "k": 1e-15}
LAWS = "blend, linear, none"
PRESSURE = "a pressure [Pa] is needed, as in '2 GPa'"


def ball(**changes):
    return {"bodies": {"ball": {"material": STEEL, **changes}}}


@pytest.fixture
def lines():
    registry = dummies.registry()

    def explained(data):
        with pytest.raises(ValidationError) as caught:
            dummies.Rig.model_validate(data, context={"registry": registry})
        return str(case_error(caught.value)).split("\n")

    return explained


BLEND = {"type": "blend", "parts": ["none", {**LINEAR, "zzz": 1}]}


@pytest.mark.parametrize(
    ("data", "path", "words"),
    [
        # Unknown keys, at each depth.
        ({"bodies": {}, "obsrevers": []}, "obsrevers", "did you mean 'observers'? Allowed: bodies"),
        (ball(wear=BLEND), "bodies.ball.wear.parts.2.zzz", "unknown key. Allowed: type, k"),
        ({"bodies": {}, "stepping": {"type": "fast", "limt": 2}}, "stepping.limt", "'limit'?"),
        # Missing ones.
        (ball(material={"poisson": 0.3}), "bodies.ball.material.young", f"missing; {PRESSURE}"),
        (ball(wear="linear"), "bodies.ball.wear.k", "as in '1e-6 mm^3/(N m)'"),
        ({"bodies": {}, "cells": [8]}, "cells.2", "missing"),
        # A misspelt key is one mistake, not an unknown key and a missing one.
        (ball(material={"yuong": 1e9, "poisson": 0.3}), "bodies.ball.material.yuong", "'young'?"),
        # Types.
        (ball(wear={"k": 1}), "bodies.ball.wear.type", f"missing; installed: {LAWS}"),
        (ball(wear={"type": "liner"}), "bodies.ball.wear.type", f"'linear'? Installed: {LAWS}"),
        (ball(wear={"type": ["linear"]}), "bodies.ball.wear.type", "must be text"),
        ({"bodies": {}, "stepping": {"type": "slwo"}}, "stepping.type", "did you mean 'slow'?"),
        ({"bodies": {}, "stepping": {"limit": 3}}, "stepping.type", "allowed: slow, fast"),
        # Wrong kinds of value.
        (ball(material=3), "bodies.ball.material", "a table is needed, 3 was given"),
        (ball(wear={**LINEAR, "passes": 2.5}), "bodies.ball.wear.passes", "a whole number"),
        (ball(wear=4), "bodies.ball.wear", "give the wear law as a table with its type"),
        ({"bodies": {}, "cells": [8, 8, 8]}, "cells", "at most 2 allowed, 3 given"),
        ({"bodies": {}, "verbose": "maybe"}, "verbose", "true or false is needed"),
        (
            {"bodies": {}, "observers": [{"type": "counter", "every": 0}]},
            "observers.1.every",
            "0: must be greater than or equal to 1",
        ),
        (3, "", "a table is needed, 3 was given"),
        ({"bodies": {}, "observers": {"type": "counter"}}, "observers", '[{ type = "counter" }]'),
        # Rules of a model.
        (ball(wear={"type": "blend", "parts": []}), "bodies.ball.wear", "give at least one part"),
        # The marks of a union's members are not part of the path.
        (
            ball(wear={"type": "blend", "parts": ["none"], "weight": "much"}),
            "bodies.ball.wear.weight",
            "a number, or 'auto' is needed, 'much' was given",
        ),
        # Names that TOML would quote.
        ({"bodies": {"my ball": {}}}, 'bodies."my ball".material', "missing"),
    ],
)
def test_a_mistake_is_one_line(lines, data, path, words):
    (line,) = lines(data)
    assert line.startswith(f"{path}: " if path else words)
    assert words in line


def test_unknown_keys_come_first(lines):
    found = lines({"cells": 3, "bodies": {"ball": {}}, "zzz": 1})
    assert [line.partition(": ")[0] for line in found] == ["zzz", "bodies.ball.material", "cells"]


def test_no_word_of_the_library_appears(lines):
    wrong = {
        "bodies": {
            "a": {"material": {"young": [], "poisson": {}}, "wear": {"type": "linear", "k": None}}
        },
        "cells": {"x": 1},
        "verbose": [],
        "stepping": 3,
        "observers": {"type": "counter"},
    }
    text = "\n".join(lines(wrong))
    assert len(text.splitlines()) == 7
    for word in ("pydantic", "Input", "input", "validation", "dict", "instance", "tuple", "str"):
        assert word not in text


@pytest.mark.parametrize("name", ["normal", "nomral"])
def test_a_model_that_is_made_stays(name):
    with pytest.raises(CaseError, match=f"^{name}: stays; make another case by with_values$"):
        setattr(Load(normal=1.0), name, 2.0)
