"""Components that are not pure."""

import random
from dataclasses import replace

import numpy as np
from testing.conformance.caught import caught_by
from testing.conformance.honest import Hill, Law, Traction


@caught_by("inputs_stay_as_they_are")
class WritesToItsInput(Law):
    def rate(self, local):
        if local.pressure.flags.writeable:
            local.pressure[0] = 0
        return super().rate(local)


@caught_by("read_only_inputs_are_accepted")
class NeedsWritableInput(Law):
    def rate(self, local):
        np.clip(local.pressure, 0, None, out=local.pressure)
        return super().rate(local)


@caught_by("same_inputs_give_same_bits")
class Remembers(Law):
    _slid: float = 0.0

    def rate(self, local):
        self._slid += 0.1
        rate = super().rate(local)
        return replace(rate, depth_rate=rate.depth_rate * np.exp(-self._slid))


@caught_by("answers_may_be_overwritten")
class GivesItsCacheAway(Hill):
    _cache: object = None

    def height(self, grid):
        if self._cache is None or self._cache.shape != grid.cells:
            self._cache = super().height(grid)
        return self._cache


@caught_by("nothing_is_printed")
class Chatters(Law):
    def rate(self, local):
        print("rate")
        return super().rate(local)


@caught_by("no_global_random_numbers")
class DrawsFromNumpy(Hill):
    def height(self, grid):
        np.random.default_rng()
        return super().height(grid) + 0 * np.random.rand()  # noqa: NPY002


@caught_by("no_global_random_numbers")
class DrawsFromPython(Traction):
    def fields(self, contact):
        random.random()
        return super().fields(contact)
