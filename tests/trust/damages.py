"""Damage result files in every way and see what reading them gives."""

import os
import random
import signal
import sys
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory

from click.testing import CliRunner
from trust.trial import start, whole

from tribo import CaseError, Result
from tribo.cli.show import show
from tribo.lab.report import lab_report
from tribo.result.summary import summary

PAGE = 4096
REFUSED, HARMLESS, WRONG = 2, 10, 11
NAMES = {REFUSED: "refused", HARMLESS: "read right", WRONG: "silently wrong", 70: "traceback"}


@dataclass
class Damages:
    """What reading damaged files came to, by the kind of damage."""

    counts: Counter = field(default_factory=Counter)
    """How many ended how, by (kind, end)."""

    def ends(self):
        """How many ended how."""
        totals = Counter()
        for (_, end), count in self.counts.items():
            totals[end] += count
        return totals

    @property
    def good(self):
        return set(self.ends()) <= {"refused", "read right"}

    def figures(self):
        """Return how many files there were, and how many ended how."""
        ends = self.ends()
        return {"files": sum(ends.values()), **{name: ends[name] for name in NAMES.values()}}


def flip(data, chance):
    """One to eight bits."""
    for _ in range(chance.randint(1, 8)):
        data[chance.randrange(len(data))] ^= 1 << chance.randrange(8)


def truncate(data, chance):
    del data[chance.randrange(len(data)) :]


def swap(data, chance):
    """Two blocks of the size of a sector, a page or several."""
    size = chance.choice((16, 512, PAGE, 4 * PAGE))
    first, second = (size * chance.randrange(max(1, len(data) // size)) for _ in range(2))
    data[first : first + size], data[second : second + size] = (
        data[second : second + size],
        data[first : first + size],
    )


def blank(data, chance):
    """A block that was never written."""
    size = chance.choice((512, PAGE, 4 * PAGE))
    at = size * chance.randrange(max(1, len(data) // size))
    data[at : at + size] = bytes(len(data[at : at + size]))


def garble(data, chance):
    """Noise in a block."""
    size = chance.randint(1, PAGE)
    at = chance.randrange(len(data))
    data[at : at + size] = chance.randbytes(len(data[at : at + size]))


def extend(data, chance):
    data += chance.randbytes(chance.randint(1, PAGE))


KINDS = (flip, truncate, swap, blank, garble, extend)


def damage_and_read(count, seed):
    """Damage `count` copies of a result and read each in a process of its own."""
    damages = Damages()
    chance = random.Random(seed)
    with TemporaryDirectory() as folder:
        path = Path(folder) / "damaged.h5"
        sound = bytearray(whole(folder).read_bytes())
        path.write_bytes(sound)
        expected = everything(path)
        while sum(damages.counts.values()) < count:
            kind = KINDS[sum(damages.counts.values()) % len(KINDS)]
            data = bytearray(sound)
            kind(data, chance)
            if data == sound:
                continue
            path.write_bytes(data)
            code, _ = start(judge, path, expected).wait()
            end = NAMES.get(code) or signal.Signals(-code).name
            damages.counts[kind.__name__, end] += 1
            if end not in ("refused", "read right"):
                kept = Path(f"{kind.__name__}-{seed}-{sum(damages.counts.values())}.h5")
                kept.write_bytes(data)
                print(f"{end}: kept as {kept}", file=sys.stderr)
    return damages


def everything(path):
    """All that a result gives, read through tribo."""
    with Result.open(path) as result:
        lab = lab_report(result).as_json()
        fields = [result.field("pressure", i).tobytes() for i in range(len(result.times))]
        for name in result.body_names:
            body = result.body(name)
            fields += [body.height, body.wear_depth, body.plastic_depth, *body.state.values()]
        table = {name: list(values) for name, values in result.table("history").items()}
        return repr((summary(result), lab, table)), [bytes(memoryview(f)) for f in fields]


def judge(path, expected, _):
    """Read a file, and exit with what came of it."""
    shown = CliRunner().invoke(show, [str(path)])
    if shown.exception is not None and not isinstance(shown.exception, CaseError):
        raise shown.exception
    try:
        found = everything(path)
    except CaseError:
        # What cannot be read must not be shown as sound either.
        os._exit(REFUSED if shown.exception is not None else WRONG)
    os._exit(HARMLESS if found == expected else WRONG)
