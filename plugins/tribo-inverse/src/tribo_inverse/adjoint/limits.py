"""The models that a gradient goes through."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from tribo import CaseError, Explicit
from tribo.kernel_api import Model, assemble, varied


def covered(model: Model) -> Model:
    """Return a model without the effects that no law follows, and no load.

    Raises
    ------
    CaseError
        If there is no gradient through a part of it.
    """
    given = {
        field.name
        for effect in model.laws.effects
        for field in (*effect.provides, *effect.state_fields)
    }
    laws = model.laws.wear.values()
    followed = model.laws.shares_load or model.laws.slips_locally
    followed = followed or any(set(law.requires) & given for law in laws)
    followed = followed or any(field.fills for f in model.laws.effects for field in f.state_fields)
    if loading := [each for each in model.laws.effects if each.changes_load]:
        raise CaseError(
            f"{loading[0]} makes the load follow the state, and no gradient goes through that; "
            "leave it out",
            "effects",
        )
    if model.contact.hardness:
        raise CaseError(
            "the largest pressure of a cell jumps in the step in which it is worn into a layer of "
            "another hardness, and so does all that follows; a gradient needs one hardness, leave "
            "that of layers out",
            "bodies",
        )
    if (
        model.case.contact.operator(
            model.contact.system, model.contact.gap <= np.min(model.contact.gap)
        )
        is None
    ):
        raise CaseError(f"{model.case.contact.type!r} does not state its operator", "contact.type")
    # Explicit steps follow a load along themselves only where something is remembered.
    if followed or not model.laws.effects or isinstance(model.case.stepping, Explicit):
        return model
    bare = assemble(varied(model.case, effects=()))
    return replace(bare, laws=replace(bare.laws, effects=()))
