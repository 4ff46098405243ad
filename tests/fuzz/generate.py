"""Cases made at random, by mutating valid ones."""

import tomllib
from copy import deepcopy
from math import inf, nan
from pathlib import Path

import tribo.templates

ROOT = Path(__file__).parents[2]
NUMBERS = (0, 1, -1, 2, 0.3, 0.5, 1e-16, 1e-9, 1e-6, 1e-3, 10, 25, 1e3, 1e9, 2e11, 1e300, 1e-320)
STRINGS = ("", " ", "5 mm", "4 GPa", "1 h", "0.3", "3 parsec", "nan Pa", "-1 m", "1e999 m", "ball")
STRINGS += ("dcfft", "wnkler", "archard", "µ", "a\tb", "x" * 300, "/dev/null")
ODD = (True, False, nan, inf, -inf, [], {}, [1, "a"], {"type": "x"}, 10**30, [[]], {"": 1})
PARTS = {
    "contact": (
        {"type": "winkler", "match": "contact_radius"},
        {"type": "tamaas.half_space"},
        {"type": "periodic"},
        {"type": "dcfft", "plasticity": False},
    ),
    "stepping": (
        {"type": "explicit", "time_step": 0.5},
        {"type": "explicit", "time_step": 2},
        {"type": "implicit", "depth_tolerance": 0.1, "pressure_tolerance": 1.0},
    ),
    "effects": ([{"type": "thermal.flash", "ambient": "90 degC"}], ["energy.friction_traction"]),
    "friction": ({"coefficient": 0.1}, {"coefficient": 0.6}),
    "load": (
        {"normal": [{"until": "3 s", "normal": "20 N"}, {"until": "1 h", "normal": "100 N"}]},
        {"normal": [{"at": 0, "normal": 10}, {"at": 9, "normal": 90}]},
    ),
    "stop": ({"depth": "0.1 µm"}, {"distance": "0.5 m"}, {"depth": "1 nm", "body": "ball"}),
}
LAWS = (
    {"type": "archard", "k": 0},
    {"type": "archard", "K": 1e-6, "hardness": "2 GPa"},
    {"type": "power", "k": 3e-16, "p_exponent": 4, "reference_pressure": 1e9},
    {"type": "energy.dissipation", "alpha": 3e-15, "threshold_energy": "1 MJ/m^2"},
    {"type": "thermal.softening", "K": 1e-6, "softening": 1e-3, "reference_temperature": 363},
)
SURFACES = (
    {"type": "flat"},
    {"type": "paraboloid", "radius": "5 mm"},
    {"type": "sphere", "radius": "20 mm"},
    {"type": "cylinder", "radius": "5 mm"},
)


def odd(chance):
    """Return what nobody expects."""
    return deepcopy(chance.choice((*NUMBERS, *STRINGS, *ODD)))


def valid_cases():
    """All cases that come with tribo."""
    texts = [tribo.templates.template(name) for name in tribo.templates.TEMPLATES]
    # Beside cases there are studies and measurements.
    return [case for case in map(tomllib.loads, texts) if {"bodies", "grid"} <= case.keys()]


def small(case, chance):
    """Make a case one that runs in a moment, where it has the tables for that."""
    if isinstance(case.get("grid"), dict):
        case["grid"]["cells"] = chance.choice((8, 16, 24, 32, [24, 16], [32, 8]))
        case["grid"]["size"] = chance.choice(("0.7 mm", "1 mm", "2 mm"))
    if isinstance(case.get("kinematics"), dict):
        for key in ("revolutions", "distance"):
            case["kinematics"].pop(key, None)
        case["kinematics"]["duration"] = chance.choice((10, 60, 300))
        if isinstance(case.get("output"), dict):
            case["output"]["save_times"] = chance.choice(([], [1, 5], [0, 2.5, 9]))
    return case


def plausible(case, chance):
    """Return a copy of `case` with numbers and parts that could be meant."""
    case = small(deepcopy(case), chance)
    paths = [path for path in places(case) if path[0] != "grid" and path[-1] != "type"]
    for *above, key in chance.sample(paths, min(len(paths), chance.choice((1, 2, 4)))):
        parent = case
        for each in above:
            parent = parent[each]
        value, factor = (
            parent[key],
            10.0 ** chance.choice((chance.uniform(-1, 1), chance.randint(-4, 4))),
        )
        if isinstance(value, float | int) and not isinstance(value, bool):
            parent[key] = value * factor
        elif isinstance(value, str) and value[:1].isdigit():
            number, _, unit = value.partition(" ")
            parent[key] = f"{float(number) * factor!r} {unit}".strip()
    for name, choices in PARTS.items():
        if chance.random() < 0.3:
            case[name] = deepcopy(chance.choice(choices))
    for body in case["bodies"].values():
        if chance.random() < 0.3:
            body["wear"] = deepcopy(chance.choice(LAWS))
        if chance.random() < 0.3:
            body["material"]["hardness"] = chance.choice((5e8, 1e9, 2e9, 4e9))
        if "effects" in case:
            body["material"] |= {"conductivity": 46, "density": 7850, "heat_capacity": 460}
            case.setdefault("friction", {"coefficient": 0.1})
    if chance.random() < 0.2:
        next(iter(case["bodies"].values()))["surface"] = deepcopy(chance.choice(SURFACES))
    return case


def places(value, path=()):
    """Yield the path of every value within a case."""
    items = value.items() if isinstance(value, dict) else enumerate(value)
    for key, each in items:
        yield (*path, key)
        if isinstance(each, dict | list):
            yield from places(each, (*path, key))


def mutated(case, chance):
    """Return a copy of `case` changed in a few places."""
    case = deepcopy(case)
    for _ in range(chance.choice((1, 1, 1, 2, 3, 5))):
        paths = list(places(case))
        if not paths:
            return case
        *above, key = chance.choice(paths)
        parent = case
        for each in above:
            parent = parent[each]
        _change(parent, key, case, paths, chance)
    return case


def _change(parent, key, case, paths, chance):
    value = parent[key]
    kind = chance.randrange(6)
    if kind == 0:
        del parent[key]
    elif kind == 1 and isinstance(parent, dict):
        parent[_misspelt(str(key), chance)] = parent.pop(key)
    elif kind == 2 and isinstance(value, int | float) and not isinstance(value, bool):
        parent[key] = value * 10.0 ** chance.randint(-6, 6) * chance.choice((1, 1, -1))
    elif kind == 3 and isinstance(value, str) and value[:1].isdigit():
        number, _, unit = value.partition(" ")
        parent[key] = f"{number}e{chance.randint(-6, 6)} {chance.choice((unit, 'GPa', 'µm', ''))}"
    elif kind == 4:
        other = case
        for each in chance.choice(paths):
            other = other[each]
        parent[key] = deepcopy(other)
    else:
        parent[key] = odd(chance)


def _misspelt(key, chance):
    at = chance.randrange(len(key) + 1)
    return key[:at] + chance.choice(("", "s", "_", "-", "X")) + key[at + 1 :]


def damaged(data, chance):
    """Return bytes with a few flipped, cut out, doubled or put in."""
    data = bytearray(data)
    for _ in range(chance.choice((1, 2, 5))):
        at = chance.randrange(len(data) + 1)
        length = min(chance.choice((1, 1, 4, 50)), len(data) - at)
        kind = chance.randrange(5)
        if kind == 0 and at < len(data):
            data[at] ^= 1 << chance.randrange(8)
        elif kind == 1:
            del data[at : at + length]
        elif kind == 2:
            data[at:at] = data[at : at + length]
        elif kind == 3:
            data[at:at] = chance.randbytes(length)
        elif chance.random() < 0.2:
            del data[at:]
    return bytes(data)
