"""Components that fail before they do anything: in their configuration, or when they are made."""

from typing import Annotated

import pytest
from pydantic import AfterValidator, ConfigDict, PrivateAttr, field_serializer, model_validator
from zoo_keeper import Zoo, case_of, expect_harmless, expect_one_message

from tribo import CaseError, Observer

ZOO = Zoo()
bad = ZOO.bad


class Watcher(Observer):
    pass


def helper(value):
    raise LookupError(f"no {value}")


@bad("could not read its keys: LookupError: no such", code=2)
class ValidatorRaises(Watcher):
    key: Annotated[str, AfterValidator(helper)] = "such"
    model_config = ConfigDict(validate_default=True)


def validated(error):
    """Return a base whose validator raises `error`."""

    class Validated(Watcher):
        @model_validator(mode="after")
        def _check(self):
            raise error

    return Validated


@bad("could not read its keys: ZeroDivisionError: by 0", code=2)
class ValidatorDivides(validated(ZeroDivisionError("by 0"))):
    pass


@bad("could not read its keys: SystemExit: 0", code=2)
class ValidatorLeaves(validated(SystemExit(0))):
    pass


@bad("refused its keys without saying why", code=2)
class ValidatorSaysNothing(validated(ValueError())):
    pass


@bad("refused its keys without saying why", code=2)
class ValidatorAsserts(validated(AssertionError())):
    pass


@bad("pressure and speed exclude each other", code=2)
class ValidatorRefuses(validated(CaseError("pressure and speed exclude each other"))):
    pass


@bad("could not read its keys: RuntimeError: no license", code=2)
class InitialisationRaises(Watcher):
    _license: object = PrivateAttr(default_factory=lambda: None)

    def model_post_init(self, context):
        raise RuntimeError("no license")


@bad("could not read its keys: OSError: no device", code=2)
class CannotBeMade(Watcher):
    def __init__(self, **keys):
        raise OSError("no device")


@bad("Error calling function")
class CannotBeWritten(Watcher):
    key: str = "value"

    @field_serializer("key")
    def _write(self, key):
        raise LookupError(key)


@bad("raised ConnectionError: offline")
class StatesNothing(Watcher):
    def facts(self):
        raise ConnectionError("offline")


@bad("facts, not text by text")
class StatesNumbers(Watcher):
    def facts(self):
        return {"size": 3}


@pytest.mark.parametrize("cls", ZOO.kept, ids=lambda cls: cls.__name__)
def test_it_ends_with_one_message(run, cls):
    expect_one_message(run(ZOO, cls), cls)


# A check writes no result, and so asks no component for its configuration.
CHECKED = [cls for cls in ZOO.kept if cls is not CannotBeWritten]


@pytest.mark.parametrize("cls", CHECKED, ids=lambda cls: cls.__name__)
def test_a_check_ends_with_it_too(tmp_path, command, cls):
    (tmp_path / "case.toml").write_text(case_of(cls))
    expect_one_message(command(ZOO, "check", "case.toml"), cls)


def test_none_harms_a_case_that_names_another(run):
    expect_harmless(run(ZOO))
