"""Wrong surfaces."""

import numpy as np
from testing.conformance.caught import caught_by
from testing.conformance.honest import Hill


@caught_by("heights_are_finite_arrays")
class SwapsAxes(Hill):
    def height(self, grid):
        return super().height(grid).T


@caught_by("finer_cells_sample_the_same_surface")
class SamplesCorners(Hill):
    def height(self, grid):
        x, y = (np.arange(n) * d for n, d in zip(grid.cells, grid.spacing, strict=True))
        return -0.5 / self.radius * (x[:, None] ** 2 + 0.5 * y[None, :] ** 2)


@caught_by("smaller_window_sees_the_same_surface")
class FillsTheWindow(Hill):
    def height(self, grid):
        x, y = grid.mesh
        return -1e-5 * ((x / grid.size[0]) ** 2 + (y / grid.size[1]) ** 2)


@caught_by("curvature_is_that_of_the_heights")
class InwardHeight(Hill):
    def height(self, grid):
        return -super().height(grid)


@caught_by("curvature_is_that_of_the_heights")
class RadiusAsCurvature(Hill):
    @property
    def curvature(self):
        return self.radius, 2 * self.radius
