"""Damage result files in every way and see what reading them gives."""

import random
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from edited import bits
from trust.trial import whole

from tribo import CaseError, Result
from tribo.result.summary import summary

PAGE = 4096


@dataclass
class Damages:
    """How many damaged files ended how; whatever else comes out of one is raised."""

    files: int = 0
    refused: int = 0
    read_right: int = 0
    silently_wrong: int = 0

    @property
    def good(self):
        return self.files == self.refused + self.read_right


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
    """Damage `count` copies of a result and read each."""
    damages, chance = Damages(), random.Random(seed)
    with TemporaryDirectory() as folder:
        path = Path(folder) / "damaged.h5"
        sound = whole(folder).read_bytes()
        path.write_bytes(sound)
        expected = everything(path)
        while damages.files < count:
            data = bytearray(sound)
            KINDS[damages.files % len(KINDS)](data, chance)
            if data == sound:
                continue
            path.write_bytes(data)
            damages.files += 1
            try:
                right = everything(path) == expected
            except CaseError:
                damages.refused += 1
            else:
                damages.read_right += right
                damages.silently_wrong += not right
    return damages


def everything(path):
    """All that a result gives, read through tribo."""
    with Result.open(path) as result:
        return repr(summary(result)), bits(result)
