"""What every surface must fulfil."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from typing import Any

import numpy as np

from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.core.rounding import SAME
from tribo.guards.parts import GuardedSurface
from tribo.testing import samples
from tribo.testing.checks import BODIES, Checks
from tribo.testing.compare import apply_if, expect_close, require

# A narrower window of it is square.
_GRID = Grid((0.54e-3, 0.88e-3), (18, 22))


class SurfaceChecks(Checks):
    """Checks of a surface."""

    def _inputs(self, component: Any, number: int) -> Grid:
        return samples.sized(self._grid(), 1 - 0.1 * number)

    def _call(self, component: Any, inputs: Any) -> Mapping[str, Any]:
        return {"height": component.height(inputs), "curvature": component.curvature}

    def _grid(self) -> Grid:
        """Return the largest of some windows that the surface reaches over, else the smallest."""
        for times in (1.0, 0.1, 0.01):
            grid = samples.sized(_GRID, times)
            with suppress(CaseError):
                self._make().height(grid)
                return grid
        return samples.sized(_GRID, 1e-3)

    def answers_fit_a_run(self) -> None:
        """Heights are finite and of the window's shape, of whatever cells; so is a curvature."""
        grid = self._grid()
        for sample in (grid, Grid(grid.size, (9, 16)), samples.finer(grid)):
            GuardedSurface(self._make(), BODIES[0], sample)

    def another_window_changes_little(self) -> None:
        """In a smaller window, on cells of a third of the size, the same points have their heights.

        But for a constant.
        """
        grid = self._grid()
        small = samples.wider(grid, -1)
        found = self._make().height(samples.finer(small, (3, 3)))[1::3, 1::3]
        needed = samples.inside(self._make().height(grid), small)
        heights = found - np.mean(found), needed - np.mean(needed)
        hint = "; sample the surface at the grid's own x and y, in m"
        expect_close(f"heights in a smaller window of finer cells{hint}", *heights, SAME)

    def curvature_is_that_of_the_heights(self) -> None:
        """The curvature is that at the highest point, positive where the body is convex."""
        surface = self._make()
        stated = surface.curvature
        apply_if(stated is not None, "curvature is None")
        grid = Grid(self._grid().size, (49, 49))
        height, (dx, dy) = surface.height(grid), grid.spacing
        # Of several points as high the one nearest the centre.
        near = height - 1e-9 * np.ptp(height) * np.hypot(*grid.mesh) / max(grid.size)
        inside = near[1:-1, 1:-1]
        i, j = np.unravel_index(int(np.argmax(inside)), inside.shape)
        found = (
            -np.diff(height, 2, axis=0)[i, j + 1] / dx**2,
            -np.diff(height, 2, axis=1)[i + 1, j] / dy**2,
        )
        for axis, one, other in zip("xy", stated, found, strict=True):
            hint = "; heights are outward from the body" if one * other < 0 else ""
            # Differences see a fourth derivative, 1 % of the curvature where cells are R/10.
            allowed = 0.02 * max(*map(abs, stated), *map(abs, found)) + 1e-6
            require(
                abs(one - other) <= allowed,
                f"the curvature along {axis} is stated as {one:.6g} 1/m, but the heights have "
                f"{other:.6g} 1/m{hint}",
            )
