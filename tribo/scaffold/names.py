"""The names of a plugin, all of which follow from the name of its distribution."""

from __future__ import annotations

import keyword
import re
from pathlib import Path

from tribo.core.errors import CaseError
from tribo.core.lazy import homes

_FORM = re.compile(r"[a-z][a-z0-9]*-[a-z][a-z0-9]*(-[a-z0-9]+)*")
_PACKAGE = Path(__file__).parents[1] / "__init__.py"


def plugin_names(distribution: str) -> dict[str, str]:
    """Return the names of a plugin by what they name.

    Parameters
    ----------
    distribution : str
        As ``acme-fretting``: words of lower-case letters and digits joined by
        hyphens. The first says whose plugin it is, the others what it is.

    Returns
    -------
    dict of str
        The ``distribution``; the ``package`` to import, ``acme_fretting``; the
        ``module`` of the model, ``fretting``; the ``component`` in a case,
        ``acme.fretting``; the ``title`` of the class, ``Fretting``.

    Raises
    ------
    CaseError
        If it is not of that form, or Python or tribo needs one of the names.
    """
    if not _FORM.fullmatch(distribution):
        raise CaseError(
            f"{distribution!r} is not allowed as a plugin's name; give its owner and subject in "
            "lower-case words joined by hyphens, as 'acme-fretting'"
        )
    prefix, _, module = distribution.replace("-", "_").partition("_")
    title = "".join(word.capitalize() for word in module.split("_"))
    for name, taken, whose in (
        (module, keyword.iskeyword(module), "a keyword of Python"),
        (title, title in homes(str(_PACKAGE)), "tribo's own"),
    ):
        if taken:
            raise CaseError(
                f"a plugin {distribution!r} would need the name {name!r}, which is {whose}; "
                "give a longer name, as 'acme-fretting'"
            )
    return {
        "distribution": distribution,
        "package": f"{prefix}_{module}",
        "module": module,
        "component": f"{prefix}.{module}",
        "title": title,
    }
