"""What every plug point has in common: a configuration and a class."""

from __future__ import annotations

from abc import ABC
from collections.abc import Mapping
from typing import ClassVar, Generic, TypeVar

from pydantic import BaseModel, ConfigDict


class ComponentConfig(BaseModel):
    """Base of every component's configuration.

    A subclass narrows ``type`` to the ``Literal`` that names it in a case.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, use_attribute_docstrings=True)

    type: str


C_co = TypeVar("C_co", bound=ComponentConfig, covariant=True)


class Component(ABC, Generic[C_co]):
    """A configured model. It holds its configuration and caches, nothing that evolves.

    Parameters
    ----------
    config : ComponentConfig
        An instance of the class's ``Config``.
    """

    Config: ClassVar[type[ComponentConfig]]

    def __init__(self, config: C_co) -> None:
        self._config = config

    @property
    def config(self) -> C_co:
        """The configuration this component was made from."""
        return self._config

    def facts(self) -> Mapping[str, str]:
        """Return what a user ought to see before a run, such as what a file was read as.

        ``tribo check`` shows it, every result keeps it, and a run does not
        resume where it has changed.

        Returns
        -------
        Mapping[str, str]
            Text by its name, as in ``{"size": "1.24 × 0.94 mm"}``.
        """
        return {}

    @classmethod
    def type_name(cls) -> str:
        """Return the name of this component in a case."""
        return str(cls.Config.model_fields["type"].default)
