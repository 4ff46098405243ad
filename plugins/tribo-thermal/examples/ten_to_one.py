"""How much of the 10:1 wear of ball and disk can frictional heating explain?

Andersson, Almqvist & Larsson weighed ten times as much off the ball as off
the disk, and name a dependence of wear on temperature as a possible cause:
the ball is always in contact, and a point of the disk recovers. Here the wear
coefficient follows Arrhenius' law in the temperature of each body's surface in
the contact, and the ball is worn to the scar of the paper's model for three
ways of sharing the heat:

shared    the surfaces touch, so both have one temperature (Blok, Ashby)
ball all  the ball takes all the heat, and the disk stays at 90 °C: the largest
          difference there can be, with a ball that is well held
held hot  the same, with ten times the way from the ball to its heat sink
"""

import math
import sys
import tomllib
import warnings

from tribo import Simulation, TriboWarning

from tribo_thermal.plugin import EXAMPLE

AMBIENT = 363.15
GAS_CONSTANT = 8.314462618

FRICTION = (0.1, 0.2, 0.3)
ENERGIES = (25, 50, 100)  # kJ/mol
BALL_ALL = {"heat_fraction": {"ball": 1.0, "disk": 0.0}}
SHARING = {
    "shared": {},
    "ball all": BALL_ALL,
    "held hot": {**BALL_ALL, "heat_paths": {"ball": {"length": "50 mm", "area": "78.5 mm^2"}}},
}

findings = {}
"""Of all runs the first of each kind."""

CONCLUSION = """
Surfaces that touch have one temperature: heating the contact makes both wear faster, and
the ratio stays 1. For the ball to wear more, a film must keep the heat out of the disk,
or the wear must follow what happens to the disk between two contacts, which these laws
do not describe. With all the heat in the ball, the friction of a lubricated contact
(0.1) still falls short of 10:1, unless the holder keeps the ball hot and the activation
energy is high. The scar that the paper weighed off the ball has twice this radius, which
halves the flash temperature. Frictional heating alone is a poor explanation."""


def case(friction, energy, sharing):
    """Return the case, with one value of each."""
    data = tomllib.loads(EXAMPLE.read_text())
    data["friction"]["coefficient"] = friction
    data["effects"][0].update(SHARING[sharing])
    for body in data["bodies"].values():
        body["wear"]["activation_energy"] = f"{energy} kJ/mol"
    return data


def ratio(friction, energy, sharing):
    """Return the volume lost by the ball over that lost by the disk."""
    result = Simulation(case(friction, energy, sharing)).run()
    for finding in result.findings:
        findings.setdefault(finding.kind, finding)
    last = result.saves()[-1]
    lost = {name: body["wear_volume_m3"] for name, body in last["bodies"].items()}
    return lost["ball"] / lost["disk"]


def needed_difference(energy, ratio=10.0):
    """Return how much hotter than the disk at 90 °C the ball must be for a ratio, in K."""
    return 1 / (1 / AMBIENT - GAS_CONSTANT * math.log(ratio) / (1e3 * energy)) - AMBIENT


def rounded(value):
    """Return `value` to two digits."""
    return float(f"{value:.1e}")


def main():
    """Print the table and what follows from it."""
    warnings.simplefilter("ignore", TriboWarning)
    table = {
        (sharing, friction, energy): ratio(friction, energy, sharing)
        for sharing in SHARING
        for friction in FRICTION
        for energy in ENERGIES
    }
    print("Volume lost by the ball over that lost by the disk; the paper weighed 10\n")
    print(f"{'heat':<10}{'friction':>9}" + "".join(f"{e:>8} kJ/mol" for e in ENERGIES))
    for sharing in SHARING:
        for friction in FRICTION:
            row = "".join(f"{rounded(table[sharing, friction, e]):15g}" for e in ENERGIES)
            print(f"{sharing:<10}{friction:>9}{row}")
    print(
        f"{'difference needed':<19}" + "".join(f"{needed_difference(e):13.0f} K" for e in ENERGIES)
    )

    print("\n10:1 is reached with")
    for sharing in SHARING:
        enough = [
            f"friction {friction} at {energy} kJ/mol"
            for friction in FRICTION
            for energy in ENERGIES
            if table[sharing, friction, energy] >= 10
        ]
        print(f"  {sharing:<10}" + (", ".join(enough) or "nothing here"))
    print(CONCLUSION)
    print(*findings.values(), sep="\n", file=sys.stderr)


if __name__ == "__main__":
    main()
