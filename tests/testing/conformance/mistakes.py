"""Models as authors write them, each with one mistake.

The table of what found each is `docs/_data/mistakes.json`; `found.py` writes it.
"""

from testing.conformance import (  # noqa: F401
    mistakes_in_cells,
    mistakes_in_contacts,
    mistakes_in_effects,
    mistakes_in_laws,
    mistakes_in_memory,
    mistakes_in_others,
    mistakes_in_process,
    mistakes_in_states,
)
from testing.conformance.mistaken import MISTAKES, configuration  # noqa: F401

globals().update({cls.__name__: cls for cls in MISTAKES.values()})
