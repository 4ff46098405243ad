"""Components that are wrong whatever they answer, by the example of a wear law."""

from itertools import count

from pydantic import PrivateAttr
from testing.conformance.caught import caught_by
from testing.conformance.honest import Law


@caught_by("facts_are_text_and_stay")
class StatesNumbers(Law):
    def facts(self):
        return {"size": 1.24e-3}


@caught_by("facts_are_text_and_stay")
class StatesAnotherEachTime(Law):
    _number: int = PrivateAttr(default_factory=count().__next__)

    def facts(self):
        return {"number": str(self._number)}
