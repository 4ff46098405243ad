"""A state that fades all along the track of a disk, of which the window shows a part."""

from collections.abc import Mapping

import tribo


class Film(tribo.Effect):
    """A film on the disk that fades in time: dt/dt = -t/tau, with tau = 10 s."""

    type = "track_state.film"
    reach = "point"
    state_fields = (tribo.Field("film", "m", "Thickness of the film."),)

    def carrier(self) -> str:
        """Return the body on which it lies."""
        return "disk"

    def initial_state(self) -> dict[str, float]:
        """Return the first thickness."""
        return {"film": 1e-6}

    def state_rates(self, contact: tribo.ContactConditions) -> Mapping[str, tribo.Array]:
        """Return what fades per second."""
        return {"film": -0.1 * contact.state["film"]}


STEEL = tribo.Material(young="207 GPa", poisson=0.3)
CASE = tribo.Case(
    grid=tribo.Grid("0.6 mm", 24),
    load="20 N",
    bodies={
        "ball": tribo.Body(surface=tribo.Paraboloid(radius="5 mm"), material=STEEL),
        "disk": tribo.Body(surface=tribo.Flat(), material=STEEL),
    },
    contact=tribo.Winkler(),
    effects=[Film()],
    kinematics=tribo.Unidirectional(speed="0.1 m/s", track_length="3 mm", duration="10 s"),
)
