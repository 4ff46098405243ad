"""Components that are wrong whatever they answer, by the example of a wear law."""

from testing.conformance.caught import caught_by
from testing.conformance.honest import Law


@caught_by("facts_are_text_and_stay")
class StatesNumbers(Law):
    def facts(self):
        return {"size": 1.24e-3}


@caught_by("facts_are_text_and_stay")
class StatesAnotherEachTime(Law):
    made = 0

    def __init__(self, config):
        super().__init__(config)
        StatesAnotherEachTime.made += 1
        self.number = StatesAnotherEachTime.made

    def facts(self):
        return {"number": str(self.number)}
