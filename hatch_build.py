"""The README of a distribution: its links lead to the repository that pyproject.toml names."""

import re
from pathlib import Path
from typing import Any

from hatchling.metadata.plugin.interface import MetadataHookInterface


class ReadmeLinks(MetadataHookInterface):
    """Put the repository before the links of the README, which a package index shows alone."""

    def update(self, metadata: dict[str, Any]) -> None:
        """Add the text of the README to the metadata."""
        text = (Path(self.root) / "README.md").read_text(encoding="utf-8")
        repository = metadata["urls"]["Repository"]
        for kind, link in (("raw", r"(!\[[^]]*\])\("), ("blob", r"(\])\((?!https?:)")):
            text = re.sub(link, rf"\1({repository}/{kind}/main/", text)
        metadata["readme"] = {"content-type": "text/markdown", "text": text}
