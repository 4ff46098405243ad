"""Effects that change the load, honest and with a mistake."""

import random
from typing import Annotated, ClassVar

import numpy as np
import pytest

from tribo.core.units import Quantity
from tribo.effects.effect import Effect
from tribo.testing.kit import names_of, outcome_of, suites


class Spring(Effect):
    """A spring that relaxes as the bodies wear: F = F₀ − S h."""

    type = "test.spring"
    relaxes: Annotated[float, Quantity("1/m", at_least=0)] = 1e4
    """Stiffness over the first load."""

    def load_factor(self, snapshot):
        return 1 - self.relaxes * sum(b.max_wear_depth for b in snapshot.measures.bodies.values())


class Pulls(Spring):
    """It pulls as soon as something is worn."""

    type = "test.pulls"

    def load_factor(self, snapshot):
        return 1.0 if snapshot.state.steps == 0 else -super().load_factor(snapshot)


class Rolls(Spring):
    """It draws from the random numbers of the process, and does without them."""

    type = "test.rolls"

    def load_factor(self, snapshot):
        random.random()
        return super().load_factor(snapshot)


class Mutes(Spring):
    """It turns warnings of NumPy off."""

    type = "test.mutes"

    def load_factor(self, snapshot):
        np.seterr(all="ignore")
        return super().load_factor(snapshot)


class Counts(Spring):
    """It remembers how often it was asked."""

    type = "test.counts"
    _asked: ClassVar[list[int]] = [0]

    def load_factor(self, snapshot):
        self._asked[0] += 1
        return super().load_factor(snapshot) - 1e-9 * self._asked[0]


class Digs(Spring):
    """It writes into the state."""

    type = "test.digs"

    def load_factor(self, snapshot):
        snapshot.state.bodies["ball"].wear[:] = 0
        return super().load_factor(snapshot)


def failed(cls):
    (checks,) = suites(cls, [{}], {})
    outcomes = {name: outcome_of(checks, name) for name in names_of(type(checks))}
    return {name: each.message for name, each in outcomes.items() if each.status == "failed"}


def test_an_honest_one_passes():
    assert failed(Spring) == {}


@pytest.mark.parametrize(
    ("cls", "words"),
    [
        (Pulls, "'load_factor' that is -"),
        (Rolls, "random"),
        (Mutes, "geterr"),
        (Counts, "resumed"),
        (Digs, "read-only"),
    ],
)
def test_the_kit_finds_a_mistake_in_the_load_that_it_makes(cls, words):
    assert words in failed(cls)["runs_in_a_case"]
