"""What every configuration must fulfil."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import ModuleType
from typing import Annotated, Any

from pydantic import TypeAdapter, ValidationError, create_model

from tribo.component import Component
from tribo.config.schema import json_schema
from tribo.config.slot import Slot
from tribo.registry.hookspecs import hookimpl
from tribo.registry.kinds import KINDS
from tribo.registry.registry import Registry
from tribo.testing.subject import Check, CheckFailed, Subject, fact, require


@fact
def config_is_frozen(subject: Subject) -> None:
    """A configuration cannot be changed once it is made."""
    config = subject.config.model_copy()
    for name in type(config).model_fields:
        try:
            setattr(config, name, getattr(config, name))
        except ValidationError:
            continue
        raise CheckFailed(
            f"{name!r} could be set; keep frozen=True, as {_base(subject).__name__} has it"
        )


@fact
def unknown_keys_are_refused(subject: Subject) -> None:
    """A key that the configuration does not have is an error."""
    try:
        type(subject.config).model_validate({**_dump(subject), "no_such_key": 1})
    except ValidationError as error:
        kinds = {detail["type"] for detail in error.errors()}
        require(
            "extra_forbidden" in kinds,
            f"'no_such_key' gave {sorted(kinds)}; it must be 'extra_forbidden'",
        )
    else:
        raise CheckFailed("'no_such_key' was accepted; keep extra='forbid'")


@fact
def quantities_have_units(subject: Subject) -> None:
    """Every real number in the configuration declares its unit."""
    bare = [name for name, schema in _properties(subject) if _is_bare(schema)]
    require(
        not bare,
        f"{', '.join(bare)}: no unit; declare it as Annotated[float, Quantity('Pa')], "
        "Quantity('1') for none",
    )


@fact
def fields_are_described(subject: Subject) -> None:
    """Every field has a description."""
    silent = [name for name, schema in _properties(subject) if not schema.get("description")]
    require(not silent, f"{', '.join(silent)}: no description; put a docstring under the field")


@fact
def config_survives_json(subject: Subject) -> None:
    """Written as JSON or as plain data and read back, a configuration is the same."""
    config = subject.config
    for how, again in (
        ("JSON", type(config).model_validate_json(config.model_dump_json())),
        ("plain data", type(config).model_validate(config.model_dump())),
    ):
        _require_equal(again, config, how)


@fact
def config_survives_without_defaults(subject: Subject) -> None:
    """Written without its defaults and read back, a configuration is the same."""
    config = subject.config
    short = config.model_dump(mode="json", exclude_defaults=True)
    again = type(config).model_validate(short)
    _require_equal(again, config, "data without defaults")


@fact
def a_case_can_name_it(subject: Subject) -> None:
    """A registry with the class takes its configuration in a case and has it in its schema."""
    registry = _registry(subject)
    slot: Any = Annotated[_base(subject), Slot(subject.kind)]
    adapter: TypeAdapter[Any] = TypeAdapter(slot)
    try:
        again = adapter.validate_python(_dump(subject), context={"registry": registry})
    except ValidationError as error:
        raise CheckFailed(f"in a case its own data are refused: {error}") from error
    _require_equal(again, subject.config, "a case")
    case: Any = create_model("Case", part=(slot, ...))
    schema = json_schema(case, registry)
    names = {
        name
        for part in _parts(schema["properties"]["part"])
        for name in part.get("discriminator", {}).get("mapping", {})
    }
    words = KINDS[subject.kind].words
    require(subject.cls.type in names, f"the schema's choice of a {words} is {sorted(names)}")


@fact
def name_has_a_prefix(subject: Subject) -> None:
    """Its name carries a prefix, as in acme.fretting; only tribo's own do without."""
    name = subject.cls.type
    fault = f"{name!r} needs a prefix, as in 'acme.fretting'; names without one are tribo's own"
    require("." in name or _is_builtin(subject), fault)


@fact
def config_reaches_a_new_process(subject: Subject) -> None:
    """A configuration can be sent to a newly started process, as workers need it."""
    arrived, said = subject.revival.answers[subject.index]
    require(arrived, f"{said}; put the class in a module that can be imported by its name")
    needed = subject.config.model_dump_json()
    require(said == needed, f"it arrived as {said}, but was {needed}")


CONFIG_CHECKS: tuple[Check, ...] = (
    config_is_frozen,
    unknown_keys_are_refused,
    quantities_have_units,
    fields_are_described,
    config_survives_json,
    config_survives_without_defaults,
    a_case_can_name_it,
    name_has_a_prefix,
    config_reaches_a_new_process,
)


def own_scales(config: Component) -> list[str]:
    """Return the names of the numbers set in `config` that are not known to be without unit."""
    schema = type(config).model_json_schema()["properties"]
    found = []
    for name, value in config:
        field = type(config).model_fields[name]
        if name == "type" or value is None or isinstance(value, bool | int | str):
            continue
        units = {part.get("x-unit") for part in _parts(schema[name])}
        if "1" in units or (units == {None} and value == field.default):
            continue
        found.append(name)
    return found


def has_unit(config: Component, unit: str) -> list[float]:
    """Return the values set in `config` whose unit is `unit`."""
    schema = type(config).model_json_schema()["properties"]
    return [
        value
        for name, value in config
        if isinstance(value, float)
        and unit in {part.get("x-unit") for part in _parts(schema[name])}
    ]


def _base(subject: Subject) -> type[Component]:
    """Return the configuration class of the interface, which is the nearest base of tribo's."""
    module = KINDS[subject.kind].interface.__module__
    for base in type(subject.config).__mro__:
        if base.__module__ == module and issubclass(base, Component):
            return base
    words = KINDS[subject.kind].interface.__name__
    raise CheckFailed(f"{type(subject.config).__name__} is not a subclass of {words}")


def _is_builtin(subject: Subject) -> bool:
    registry = Registry.with_plugins()
    name = subject.cls.type
    return (
        name in registry.names(subject.kind) and registry.lookup(subject.kind, name) is subject.cls
    )


def _registry(subject: Subject) -> Registry:
    if _is_builtin(subject):
        return Registry.with_plugins()
    plugin = ModuleType("checked")
    plugin.tribo_components = hookimpl(  # type: ignore[attr-defined]
        specname="tribo_components"
    )(lambda: [subject.cls])
    return Registry.with_plugins(plugin)


def _dump(subject: Subject) -> dict[str, Any]:
    return subject.config.model_dump(mode="json")


def _require_equal(again: object, config: Component, how: str) -> None:
    require(again == config, f"read back from {how} it is {again!r}, but it was {config!r}")


def _properties(subject: Subject) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """Yield every field with its schema, those of nested tables too, but not `type`."""
    schema = type(subject.config).model_json_schema()
    tables = {"": schema, **schema.get("$defs", {})}
    for table, inner in tables.items():
        for name, part in inner.get("properties", {}).items():
            if name != "type":
                yield f"{table}.{name}".lstrip("."), part


def _is_bare(schema: Mapping[str, Any]) -> bool:
    """Whether a number without a unit is possible here; nested tables are looked at elsewhere."""
    if "x-unit" in schema:
        return False
    if schema.get("type") == "number":
        return True
    inner = [*schema.get("anyOf", ()), *schema.get("prefixItems", ())]
    inner += [schema[key] for key in ("items", "additionalProperties") if key in schema]
    return any(_is_bare(part) for part in inner if isinstance(part, Mapping))


def _parts(schema: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
    yield schema
    for part in schema.get("anyOf", ()):
        yield from _parts(part)
