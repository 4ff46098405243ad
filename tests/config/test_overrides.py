"""Changes from the command line reach any value, and never get lost silently."""

import copy

import pytest

import tribo
from tribo.config.overrides import apply_settings, leaves_at
from tribo.core.errors import CaseError

DATA = {
    "load": {"normal": 100.0},
    "contact": {"type": "dcfft", "tolerance": 1e-8},
    "bodies": {"ball": {"wear": {"type": "archard", "k": 1e-16}, "surface": "flat"}},
    "effects": [{"type": "heat", "rate": 1}, "glow"],
}


def changed(*overrides):
    before = copy.deepcopy(DATA)
    result = apply_settings(DATA, overrides)
    assert before == DATA
    return result


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1e-15", 1e-15),
        ("[1, 2]", [1, 2]),
        ('"5 mm"', "5 mm"),
        ("5 mm", "5 mm"),
        ("", ""),
        ("1\nx = 2", "1\nx = 2"),
    ],
)
def test_a_value_is_toml_or_else_text(text, value):
    assert changed(f"load.normal={text}")["load"]["normal"] == value


def test_missing_tables_are_added_and_the_last_of_two_values_counts():
    assert changed("load.normal=1", "load.normal=2")["load"] == {"normal": 2}
    assert changed("friction.coefficient = 0.1")["friction"] == {"coefficient": 0.1}
    assert apply_settings({}, "load.normal=50") == {"load": {"normal": 50}}
    assert changed("bodies.disk.wear.k=1")["bodies"]["disk"] == {"wear": {"k": 1}}
    assert changed('bodies."a.b".x=1')["bodies"]["a.b"] == {"x": 1}


def test_lists_are_reached_by_index():
    assert changed("effects.1.rate=2")["effects"][0] == {"type": "heat", "rate": 2}
    assert changed("effects.2=heat")["effects"] == [DATA["effects"][0], "heat"]


def test_another_type_drops_the_keys_of_the_former_and_the_same_keeps_them():
    assert changed("contact.type=winkler")["contact"] == {"type": "winkler"}
    assert changed("effects.1.type=glow")["effects"][0] == {"type": "glow"}
    assert changed("contact.type=dcfft") == DATA


@pytest.mark.parametrize("reverse", [False, True])
def test_keys_of_the_new_type_survive_in_any_order(reverse):
    overrides = ["contact.type=winkler", "contact.modulus=1"]
    result = changed(*(reversed(overrides) if reverse else overrides))
    assert result["contact"] == {"type": "winkler", "modulus": 1}


def test_a_value_that_is_short_for_a_table_is_one():
    """As the validation reads them."""
    data = {"load": "40 N", "friction": 0.1}
    changed = apply_settings(data, ["load.normal=25 N", "friction.coefficient=0.2"])
    assert changed == data | {"load": {"normal": "25 N"}, "friction": {"coefficient": 0.2}}
    stages = {"load": [{"until": 1, "force": 2}]}
    assert apply_settings(stages, "load.1.force=3") == {"load": [{"until": 1, "force": 3}]}


def test_a_name_alone_is_a_table_with_its_type():
    ball = changed("bodies.ball.surface.tilt=1")["bodies"]["ball"]
    assert ball["surface"] == {"type": "flat", "tilt": 1}


@pytest.mark.parametrize(
    ("override", "message"),
    [
        ("load.normal", "is not of the form path=value"),
        ("=3", "'' is not a path"),
        ("a..b=3", "'a..b' is not a path"),
        ("a\nb=3", "is not a path"),
        ("effects.3.rate=1", "effects: '3' is no entry of this list; allowed: 1 to 2"),
        ("effects.0.rate=1", "allowed: 1 to 2"),
        ("effects=[heat]", "effects: '[heat]' is not TOML"),
        ("load.normal.x=1", "load.normal: is not a table"),
    ],
)
def test_a_malformed_override_is_refused(override, message):
    with pytest.raises(CaseError) as caught:
        changed(override)
    assert message in str(caught.value)


def test_a_value_in_a_list_of_pairs_has_its_own_unit():
    path = tribo.Measured(path=[[0, -1e-3], [1, 1e-3], [2, -1e-3]], cycles=2)
    assert leaves_at(path, "path.2") == [("path.2.1", 1.0, "s"), ("path.2.2", 1e-3, "m")]
