"""Damage result files and see what reading them gives."""

import random
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from edited import bits
from fuzz.generate import damaged
from trust.trial import whole

from tribo import CaseError, Result
from tribo.result.summary import summary


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


def damage_and_read(count, seed):
    """Damage `count` copies of a result and read each."""
    damages, chance = Damages(), random.Random(seed)
    with TemporaryDirectory() as folder:
        path = Path(folder) / "damaged.h5"
        sound = whole(folder).read_bytes()
        path.write_bytes(sound)
        expected = everything(path)
        while damages.files < count:
            data = damaged(sound, chance)
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
