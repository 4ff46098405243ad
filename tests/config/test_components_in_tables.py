"""A field of a kind takes any registered component, and gives it back whole."""

import json
import os
import pickle
import subprocess
import sys
from pathlib import Path

import jsonschema
import pytest
from pydantic import ValidationError

from tribo import Registry
from tribo.config.schema import json_schema
from tribo.registry import registry as registry_module

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
def validate(dummies):
    context = {"registry": dummies.registry()}
    return lambda data: dummies.Rig.model_validate(data, context=context)


def test_a_table_becomes_the_component_its_type_names(dummies, validate):
    before = json.dumps(DATA)
    rig = validate(DATA)
    assert json.dumps(DATA) == before
    assert rig.bodies["ball"].wear == dummies.Linear(k=1e-15)
    assert rig.bodies["disk"].wear.parts == (dummies.NoWear(), dummies.Linear(k=1e-15))
    assert rig.bodies["ball"].surface == dummies.Plane()
    assert rig.observers == (dummies.Counter(), dummies.Counter(every=2))


@pytest.mark.parametrize("options", [{}, {"exclude_defaults": True}, {"exclude_unset": True}])
def test_what_is_written_can_be_read_back(dummies, validate, options):
    rig = validate(DATA)
    dumped = rig.model_dump(**options)
    assert dumped["bodies"]["disk"]["wear"]["parts"][1]["type"] == "linear"
    assert validate(dumped) == rig
    text, context = rig.model_dump_json(**options), {"registry": dummies.registry()}
    assert dummies.Rig.model_validate_json(text, context=context) == rig


def test_without_a_context_the_default_registry_is_asked(dummies, monkeypatch):
    monkeypatch.setattr(registry_module, "default_registry", dummies.registry)
    assert dummies.Rig.model_validate(DATA).bodies["ball"].wear == dummies.Linear(k=1e-15)


@pytest.mark.slow
def test_a_worker_process_unpickles_without_any_registry(validate):
    rig = validate(DATA)
    code = (
        "import pickle, sys\n"
        "rig = pickle.load(sys.stdin.buffer)\n"
        "from tribo.registry.registry import default_registry\n"
        "assert default_registry.cache_info().currsize == 0\n"
        "sys.stdout.write(rig.model_dump_json())"
    )
    path = os.pathsep.join([str(Path(__file__).parent), *filter(None, sys.path)])
    worker = subprocess.run(
        [sys.executable, "-c", code],
        input=pickle.dumps(rig),
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        check=True,
    )
    assert worker.stdout.decode() == rig.model_dump_json()


@pytest.fixture
def schema(dummies):
    return json_schema(dummies.Rig, dummies.registry())


@pytest.mark.parametrize(
    "wear",
    [
        {"k": 1},
        {"type": "liner", "k": 1},
        {"type": "linear"},
        {"type": "linear", "k": 0},
        {"type": "linear", "k": 1, "z": 1},
        "linear",
        {"type": "blend", "parts": [{}]},
        3,
    ],
)
def test_the_json_schema_accepts_what_validates_and_refuses_what_does_not(schema, validate, wear):
    jsonschema.Draft202012Validator.check_schema(schema)
    jsonschema.validate(DATA, schema)
    with pytest.raises(ValidationError):
        validate(ball(wear))
    refuses(ball(wear), schema)


def test_the_json_schema_discriminates_by_a_required_type(schema):
    assert {"$ref": "#/$defs/wear_law"} in schema["$defs"]["Body"]["properties"]["wear"]["anyOf"]
    choice, names = schema["$defs"]["wear_law"]["anyOf"]
    mapping = {name: f"#/$defs/{name}" for name in ("blend", "linear", "none")}
    assert choice["discriminator"] == {"propertyName": "type", "mapping": mapping}
    assert choice["oneOf"] == [{"$ref": ref} for ref in mapping.values()]
    assert names == {"type": "string", "enum": ["none"]}
    linear = schema["$defs"]["linear"]
    assert linear["required"] == ["type", "k"]
    assert linear["properties"]["k"]["description"] == "Coefficient."
    assert linear["properties"]["k"]["x-unit"] == "1/Pa"


def test_the_json_schema_follows_the_registry(dummies):
    one = json_schema(dummies.Rig, dummies.registry(dummies.NoWear))
    jsonschema.validate(ball("none"), one)
    refuses(ball({"type": "linear", "k": 1}), one)
    none = json_schema(dummies.Rig, Registry([]))
    jsonschema.validate({"bodies": {"a": {"material": MATERIAL}}, "observers": []}, none)
    refuses({"bodies": {}, "observers": ["counter"]}, none)
