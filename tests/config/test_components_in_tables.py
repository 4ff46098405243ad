"""A field of a kind takes any registered component, and gives it back whole."""

import json
import pickle

import dummies_in_tables as dummies
import jsonschema
import pytest
from pydantic import ValidationError

from tribo import Registry
from tribo.config.schema import json_schema

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


def ball(wear):
    return {"bodies": {"ball": {"material": MATERIAL, "wear": wear}}}


def refuses(data, schema):
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(data, schema)


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


@pytest.fixture
def schema():
    return json_schema(dummies.Rig, dummies.registry())


@pytest.mark.parametrize(
    "wear",
    [
        {"type": "liner", "k": 1},
        {"type": "linear", "k": 0},
        {"type": "linear", "k": 1, "z": 1},
        "linear",
        {"type": "blend", "parts": [{}]},
    ],
)
def test_the_json_schema_accepts_what_validates_and_refuses_what_does_not(schema, validate, wear):
    jsonschema.Draft202012Validator.check_schema(schema)
    jsonschema.validate(DATA, schema)
    with pytest.raises(ValidationError):
        validate(ball(wear))
    refuses(ball(wear), schema)


def test_the_json_schema_follows_the_registry():
    one = json_schema(dummies.Rig, dummies.registry(dummies.NoWear))
    jsonschema.validate(ball("none"), one)
    refuses(ball({"type": "linear", "k": 1}), one)
    none = json_schema(dummies.Rig, Registry([]))
    jsonschema.validate({"bodies": {"a": {"material": MATERIAL}}, "observers": []}, none)
    refuses({"bodies": {}, "observers": ["counter"]}, none)
