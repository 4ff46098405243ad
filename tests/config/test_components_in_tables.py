"""A field of a kind takes any registered component, and gives it back whole."""

from __future__ import annotations

import json
import os
import pickle
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from pydantic import ValidationError

from tribo.config.schema import json_schema
from tribo.registry import registry as registry_module
from tribo.registry.registry import Registry

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
def validate(dummies: Any) -> Callable[..., Any]:
    context = {"registry": dummies.registry()}
    return lambda data, model=dummies.Rig: model.model_validate(data, context=context)


def test_a_table_becomes_the_configuration_its_type_names(dummies: Any, validate: Any) -> None:
    before = json.dumps(DATA)
    rig = validate(DATA)
    assert json.dumps(DATA) == before
    assert rig.bodies["ball"].wear == dummies.Linear(k=1e-15)
    assert rig.bodies["disk"].wear.parts == (dummies.NoWear(), dummies.Linear(k=1e-15))
    assert rig.bodies["ball"].surface == dummies.Plane()
    assert rig.observers == (dummies.Counter(), dummies.Counter(every=2))


def test_an_instance_passes_through(dummies: Any) -> None:
    wear = dummies.Linear(k=1e-15)
    assert dummies.Body(material=MATERIAL, wear=wear).wear is wear


@pytest.mark.parametrize("options", [{}, {"exclude_defaults": True}, {"exclude_unset": True}])
def test_what_is_written_can_be_read_back(
    dummies: Any, validate: Any, options: dict[str, Any]
) -> None:
    rig = validate(DATA)
    dumped = rig.model_dump(**options)
    assert dumped["bodies"]["disk"]["wear"]["parts"][1]["type"] == "linear"
    assert validate(dumped) == rig
    assert validate(rig.model_dump(mode="json", **options)) == rig
    text, context = rig.model_dump_json(**options), {"registry": dummies.registry()}
    assert dummies.Rig.model_validate_json(text, context=context) == rig


def test_options_of_dumping_reach_into_a_component(validate: Any) -> None:
    rig = validate(DATA)
    assert rig.model_dump(exclude_defaults=True)["observers"] == (
        {"type": "counter"},
        {"type": "counter", "every": 2},
    )
    dumped = rig.model_dump(exclude={"bodies": {"ball": {"wear": {"k"}}}})
    assert dumped["bodies"]["ball"]["wear"] == {"type": "linear", "passes": 3}


def test_without_a_context_the_default_registry_is_asked(
    dummies: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(registry_module, "default_registry", dummies.registry)
    assert dummies.Rig.model_validate(DATA).bodies["ball"].wear == dummies.Linear(k=1e-15)


@pytest.mark.slow
def test_a_worker_process_unpickles_without_any_registry(validate: Any) -> None:
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
def schema(dummies: Any) -> dict[str, Any]:
    return json_schema(dummies.Rig, dummies.registry())


def test_the_json_schema_is_one_and_accepts_what_validates(schema: dict[str, Any]) -> None:
    jsonschema.Draft202012Validator.check_schema(schema)
    jsonschema.validate(DATA, schema)


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
def test_the_json_schema_refuses_what_does_not_validate(
    schema: dict[str, Any], validate: Any, wear: object
) -> None:
    data = {"bodies": {"ball": {"material": MATERIAL, "wear": wear}}}
    with pytest.raises(ValidationError):
        validate(data)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(data, schema)


def test_the_json_schema_discriminates_by_a_required_type(schema: dict[str, Any]) -> None:
    assert {"$ref": "#/$defs/wear_law"} in schema["$defs"]["Body"]["properties"]["wear"]["anyOf"]
    choice, names = schema["$defs"]["wear_law"]["anyOf"]
    assert choice["discriminator"] == {
        "propertyName": "type",
        "mapping": {name: f"#/$defs/{name}" for name in ("blend", "linear", "none")},
    }
    assert choice["oneOf"] == [{"$ref": ref} for ref in choice["discriminator"]["mapping"].values()]
    assert names == {"type": "string", "enum": ["none"]}
    linear = schema["$defs"]["linear"]
    assert linear["required"] == ["type", "k"]
    assert linear["properties"]["k"]["description"] == "Coefficient."
    assert linear["properties"]["k"]["x-unit"] == "1/Pa"


def test_the_json_schema_follows_the_registry(dummies: Any) -> None:
    one = json_schema(dummies.Rig, dummies.registry(dummies.NoWear))
    assert "linear" not in one["$defs"]
    jsonschema.validate({"bodies": {"a": {"material": MATERIAL, "wear": "none"}}}, one)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate({"bodies": {"a": {"material": MATERIAL, "wear": DATA}}}, one)


def test_the_json_schema_of_output_has_no_short_forms(dummies: Any) -> None:
    written = json_schema(dummies.Rig, dummies.registry(), mode="serialization")
    jsonschema.Draft202012Validator.check_schema(written)
    context = {"registry": dummies.registry()}
    jsonschema.validate(
        dummies.Rig.model_validate(DATA, context=context).model_dump(mode="json"), written
    )
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(DATA, written)


def test_a_kind_without_components_takes_nothing(dummies: Any) -> None:
    schema = json_schema(dummies.Rig, Registry([]))
    jsonschema.validate({"bodies": {"a": {"material": MATERIAL}}, "observers": []}, schema)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate({"bodies": {}, "observers": ["counter"]}, schema)
