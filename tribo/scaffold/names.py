"""The names of a plugin, all of which follow from that of its distribution."""

from __future__ import annotations

import keyword
import re
from dataclasses import dataclass

import tribo
from tribo.core.errors import CaseError

_FORM = re.compile(r"[a-z][a-z0-9]*-[a-z][a-z0-9]*(-[a-z0-9]+)*")
_LONGEST = 30
"""What keeps the lines of the files within 100 characters."""


@dataclass(frozen=True)
class PluginName:
    """The name of a distribution, as ``acme-fretting``.

    Parameters
    ----------
    distribution : str
        Words of lower-case letters and digits joined by hyphens, at most 30
        characters. The first says whose plugin it is, the others what it is.

    Raises
    ------
    CaseError
        If it is not of that form or length, or Python or tribo needs one of the names
        that follow from it.
    """

    distribution: str

    def __post_init__(self) -> None:
        """Refuse a name from which no other can be made."""
        given = self.distribution
        if not _FORM.fullmatch(given):
            raise CaseError(
                f"{given!r} is no good as a plugin's name; {self._remedy()}: whose it is and "
                "what it is, in lower-case words joined by hyphens"
            )
        if len(given) > _LONGEST:
            raise CaseError(
                f"{given!r} is too long for a plugin's name; {_LONGEST} characters are allowed"
            )
        if keyword.iskeyword(self.module) or self.title in tribo.__all__:
            what = "a keyword of Python" if keyword.iskeyword(self.module) else "tribo's own"
            name = self.module if keyword.iskeyword(self.module) else self.title
            raise CaseError(
                f"a plugin {given!r} would need the name {name!r}, which is {what}; let its name "
                "say more, as in 'acme-fretting'"
            )

    @property
    def package(self) -> str:
        """The package to import, as ``acme_fretting``."""
        return self.distribution.replace("-", "_")

    @property
    def prefix(self) -> str:
        """Whose it is, as ``acme``."""
        return self.distribution.partition("-")[0]

    @property
    def module(self) -> str:
        """The module of the model, as ``fretting``."""
        return self.distribution.partition("-")[2].replace("-", "_")

    @property
    def component(self) -> str:
        """The name in a case, as ``acme.fretting``."""
        return f"{self.prefix}.{self.module}"

    @property
    def title(self) -> str:
        """The class of the model, as ``Fretting``."""
        return "".join(word.capitalize() for word in self.module.split("_"))

    def _remedy(self) -> str:
        words = re.findall(r"[a-z0-9]+", self.distribution.lower())
        if len(words) == 1 and words != ["acme"]:
            words = ["acme", *words]
        mended = "-".join(words)
        return f"try {mended!r}" if _FORM.fullmatch(mended) else "one is needed as 'acme-fretting'"
