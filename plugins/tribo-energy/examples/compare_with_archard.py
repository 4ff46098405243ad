"""Wear by dissipated energy beside Archard's law: the same test where α = k/μ."""

import tomllib

from tribo import Simulation

from tribo_energy.plugin import EXAMPLE


def depths(case):
    """Deepest wear of each body at the end, in µm."""
    last = Simulation(case).run().saves()[-1]
    return {name: 1e6 * body["max_wear_depth_m"] for name, body in last["bodies"].items()}


def main():
    energy = tomllib.loads(EXAMPLE.read_text())
    archard = tomllib.loads(EXAMPLE.read_text())
    # Archard with the k = α μ of the full friction, and energy wear with half of it.
    for body in archard["bodies"].values():
        body["wear"] = {"type": "archard", "k": "3.11e-16 1/Pa"}
    slippery = {**energy, "friction": {"coefficient": 0.05}}
    for label, case in [("archard", archard), ("energy", energy), ("half friction", slippery)]:
        ball, disk = depths(case).values()
        print(f"{label:>14}: ball {ball:6.2f} µm, disk {disk:6.2f} µm")


if __name__ == "__main__":
    main()
