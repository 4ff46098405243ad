"""A state that fades all along a track, of which the window shows a part."""

from collections.abc import Mapping

import tribo
from tribo.verification.cases.pins import pin_on_flat


class Film(tribo.Effect):
    """A film on the flat that fades in time: dt/dt = -t/tau, with tau = 10 s."""

    type = "track_state.film"
    reach = "point"
    state_fields = (tribo.Field("film", "m", "Thickness of the film."),)

    def carrier(self) -> str:
        """Return the body on which it lies."""
        return "flat"

    def initial_state(self) -> dict[str, float]:
        """Return the first thickness."""
        return {"film": 1e-6}

    def state_rates(self, contact: tribo.ContactConditions) -> Mapping[str, tribo.Array]:
        """Return what fades per second."""
        return {"film": -0.1 * contact.state["film"]}


CASE = pin_on_flat(
    tribo.Paraboloid(radius="5 mm"),
    grid=tribo.Grid("0.6 mm", 24),
    load="20 N",
    contact=tribo.Winkler(),
    effects=[Film()],
    kinematics=tribo.Unidirectional(speed="0.1 m/s", track_length="3 mm", duration="10 s"),
)
