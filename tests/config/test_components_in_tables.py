"""A field of a kind takes any registered component, and gives it back whole."""

import json
import pickle

import dummies_in_tables as dummies
import pytest

MATERIAL = {"young": "207 GPa", "poisson": 0.3}
DATA = {
    "bodies": {
        "ball": {"material": MATERIAL, "wear": {"type": "linear", "k": "1e-15 1/Pa"}},
        "disk": {
            "material": MATERIAL,
            "wear": {"type": "blend", "parts": ["none", {"type": "linear", "k": 1e-15}]},
        },
    },
    "observers": ["counter", {"type": "counter", "every": 2}],
}


@pytest.fixture
def validate():
    context = {"registry": dummies.registry()}
    return lambda data: dummies.Rig.model_validate(data, context=context)


def test_a_table_becomes_the_component_its_type_names(validate):
    before = json.dumps(DATA)
    rig = validate(DATA)
    assert json.dumps(DATA) == before
    assert rig.bodies["ball"].wear == dummies.Linear(k=1e-15)
    assert rig.bodies["disk"].wear.parts == (dummies.NoWear(), dummies.Linear(k=1e-15))
    assert rig.bodies["ball"].surface == dummies.Plane()
    assert rig.observers == (dummies.Counter(), dummies.Counter(every=2))


@pytest.mark.parametrize("options", [{}, {"exclude_defaults": True}, {"exclude_unset": True}])
def test_what_is_written_can_be_read_back(validate, options):
    rig = validate(DATA)
    dumped = rig.model_dump(**options)
    assert dumped["bodies"]["disk"]["wear"]["parts"][1]["type"] == "linear"
    assert validate(dumped) == rig
    assert validate(json.loads(rig.model_dump_json(**options))) == rig
    assert pickle.loads(pickle.dumps(rig)) == rig
