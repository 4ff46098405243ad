"""Effects of each kind that a gradient goes through, and some that it does not."""

import numpy as np
from tribo.core.fields import LOAD_SHARE, LOCAL_SLIP, Field
from tribo.effects.effect import Effect
from tribo.wear.archard import Archard
from tribo.wear.modified import times


class Grains(Effect):
    """What wear leaves, which lifts the bodies apart and takes its part of the load."""

    type = "grains"
    reach = "point"
    begins: float = 2e-8
    cover: float = 1e-6
    stays: float = 2.0
    on: str | None = None
    state_fields = (Field("grains", "m", "Height of grains.", at_least=0, fills=True),)
    provides = (LOAD_SHARE,)

    def carrier(self):
        return self.on

    def initial_state(self):
        return {"grains": self.begins}

    def fields(self, contact):
        share = -np.expm1(-contact.state["grains"] / self.cover)
        return {"load_share": dict.fromkeys(contact.materials, share)}

    def state_rates(self, contact):
        caught = sum(contact.wear_rates.values())
        leaves = contact.state["grains"] / self.stays * (contact.pressure > 0)
        return {"grains": contact.speed * (caught - leaves)}


class Dust(Grains):
    """Such grains that are too few to lift the bodies, so that each point follows its own cells."""

    type = "dust"
    state_fields = (Field("grains", "m", "Height of grains.", at_least=0),)


class Buried(Archard):
    type = "buried"
    requires = ("grains",)

    def rate(self, local):
        return times(np.exp(-local.fields["grains"] / 1e-7), super().rate(local))


class Heat(Effect):
    """A temperature after the load and the area of the contact, and of a bulk that warms."""

    type = "heat"
    reach = "contact"
    flash: float = 1e-2
    capacity: float = 2.0
    provides = (Field("temperature", "K", "Above that around."),)
    state_fields = (Field("bulk", "K", "Of the bodies, above that around.", uniform=True),)

    def power(self, contact):
        return 0.1 * contact.speed * np.sum(contact.pressure) * contact.grid.cell_area

    def fields(self, contact):
        p = contact.pressure
        area = np.sum(p) ** 2 / np.sum(p**2) * contact.grid.cell_area
        found = contact.state["bulk"] + self.flash * self.power(contact) / np.sqrt(area)
        return {"temperature": dict.fromkeys(contact.materials, found)}

    def state_rates(self, contact):
        rate = (self.power(contact) - 0.005 * contact.state["bulk"]) / self.capacity
        return {"bulk": np.reshape(rate, (1, 1))}


class Sinks(Heat):
    """Of which both bodies lead the more away the better they conduct."""

    material_properties = (Field("leads", "W/(m K)", "Conductivity.", at_least=0),)

    def power(self, contact):
        leads = sum(material.property("leads") for material in contact.materials.values())
        return 90.0 / leads * super().power(contact)


class Slips(Effect):
    """Points slip the more the more they bear, and the flatter the bodies are."""

    type = "slips"
    reach = "point"
    most: float = 3e9
    provides = (LOCAL_SLIP,)

    def fields(self, contact):
        slip = (contact.pressure / self.most) ** 2 * 5e-3 * contact.system.curvature[0]
        return {"local_slip": dict.fromkeys(contact.materials, slip)}


class Softens(Archard):
    type = "softens"
    requires = ("temperature",)

    def rate(self, local):
        return times(np.exp(0.02 * local.fields["temperature"]), super().rate(local))


class Mirrors(Effect):
    """A temperature that follows the pressure at the other side."""

    type = "mirrors"
    provides = Heat.provides

    def fields(self, contact):
        beyond = 1e-8 * contact.pressure[:, ::-1]
        return {"temperature": dict.fromkeys(contact.materials, beyond)}


class Grows(Effect):
    """A layer that grows under pressure in time, at rest too, and flows off."""

    type = "grows"
    reach = "point"
    begins: float = 2e-8
    rate: float = 5e-17
    stays: float = 5.0
    state_fields = (Field("grown", "m", "Height of the layer.", at_least=0, fills=True),)

    def initial_state(self):
        return {"grown": self.begins}

    def state_rates(self, contact):
        return {"grown": self.rate * contact.pressure - contact.state["grown"] / self.stays}


class Levers(Heat):
    """Heat that says by a method of its own that the load is as it is."""

    type = "levers"

    def load_factor(self, snapshot):
        return 1.0
