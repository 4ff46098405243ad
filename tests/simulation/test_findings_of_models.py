"""Models and observers that warn of a step, or end the run."""

import warnings

import pytest
from paper_models import K, archard, small

from tribo import Archard, Finding, Observer, PluginError, Simulation, Stop, TriboWarning
from tribo.simulation.assembly import assemble
from tribo.simulation.predict import predict


class Hot(Archard):
    """Warns of a pressure."""

    type = "test.hot"

    def findings(self, snapshot):
        """Say that the contact is pressed less than at first."""
        if snapshot.measures.max_pressure < 1.2e9:
            yield Finding("cool", "pressed by less than 1.2 GPa", value=1.2e9)


class Until(Observer):
    """Ends the run at a distance."""

    type = "test.until"
    distance: float = 2.0

    def findings(self, snapshot):
        """Return a reason to stop, once it has come so far."""
        if snapshot.state.distance < self.distance:
            return ()
        return (Finding("stop", f"ended by {self.type}"),)


def case(law, observers=()):
    bodies = small().case.bodies
    worn = {n: b.model_copy(update={"wear": law}) for n, b in bodies.items()}
    changes = {"bodies": worn, "observers": observers, "stop": Stop(distance=6)}
    return small().case.model_copy(update=changes)


def test_a_law_warns_once_of_each_body_with_time_and_place():
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", TriboWarning)
        result = case(Hot(k=K)).run()
    found = [each for each in result.findings if each.kind == "cool"]
    assert [each.place for each in found] == ["bodies.ball.wear", "bodies.disk.wear"]
    assert all(0 < each.time < result.times[-1] for each in found)
    assert sum("less than 1.2 GPa" in str(each.message) for each in caught) == 2


def test_an_observer_ends_the_run_with_its_reason():
    result = case(archard(K), (Until(),)).run()
    assert result.status == "done"
    assert 2.0 <= result.distances[-1] < 3.0
    (stop,) = (each for each in result.findings if each.kind == "stop")
    assert (stop.words, stop.place) == ("ended by test.until", "observers.1")


def test_an_observer_of_the_run_alone_and_the_trial_of_a_check_end_it_too():
    result = case(archard(K)).run(observers=[Until()])
    assert (result.status, result.warnings[-1].split()[-1]) == ("done", "test.until")
    said = [each.words for each in predict(assemble(case(archard(K), (Until(),)))).problems]
    (foreseen,) = [each for each in said if each.endswith("ended by test.until")]
    assert foreseen.startswith("at ")


class Fails(Archard):
    """Raises, or says what is no finding."""

    type = "test.fails"
    says: tuple[str, ...] = ()

    def findings(self, snapshot):
        """Divide by the number of what it has to say."""
        return self.says[: 1 // len(self.says)]


@pytest.mark.parametrize(
    ("says", "words"),
    [((), r"test\.fails.*ZeroDivisionError"), (("hot",), "gave a str as a finding.*a Finding")],
)
def test_a_model_that_fails_to_speak_or_says_no_finding_is_named(says, words):
    with pytest.raises(PluginError, match=words):
        Simulation(case(Fails(k=K, says=says))).run()
