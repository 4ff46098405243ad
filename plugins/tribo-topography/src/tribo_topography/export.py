"""Write worn surfaces for the programs that look at measured ones."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from tribo import Result


def export_xyz(result: Result, folder: Path) -> list[Path]:
    """Write the surface of each body at the last save as lines of x, y and height, in m.

    Heights are outward from the body, less what was worn and what yielded.

    Returns
    -------
    list of Path
        NAME.xyz of each body NAME.
    """
    grid = result.grid
    x, y = np.meshgrid(grid.x, grid.y, indexing="ij")
    folder.mkdir(parents=True, exist_ok=True)
    paths = []
    for name in result.body_names:
        body = result.body(name)
        height = body.height - body.wear_depth[-1] - body.plastic_depth[-1]
        path = folder / f"{name}.xyz"
        np.savetxt(path, np.column_stack([x.ravel(), y.ravel(), height.ravel()]), fmt="%.9e")
        paths.append(path)
    return paths
