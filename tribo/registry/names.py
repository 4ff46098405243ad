"""What a third party may call a component."""

from __future__ import annotations

import re

_FORM = re.compile(r"[a-z]\w*(\.\w+)+", re.ASCII)
_RESERVED = "tribo"


def name_fault(name: str) -> str:
    """Return why a third party may not call a component `name`; empty if it may.

    A name is a prefix, which says whose it is, and a name after a dot, as
    ``acme.fretting``: ASCII letters, digits and underscores, the first a
    lower-case letter.
    """
    if "." not in name:
        return f"{name!r} needs a prefix, as in 'acme.fretting': names without one are tribo's own"
    if name.split(".")[0] == _RESERVED:
        return f"{name!r} has the prefix {_RESERVED!r}, which is tribo's own; use your own"
    if not _FORM.fullmatch(name):
        return (
            f"{name!r} is not made of a prefix, a dot and a name in ASCII letters, digits and "
            "underscores, with a lower-case letter first, as 'acme.fretting' is"
        )
    return ""
