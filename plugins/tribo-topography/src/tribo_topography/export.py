"""Write worn surfaces for the programs that look at measured ones."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path

import numpy as np
from tribo import Result
from tribo.kernel_api import make_folder, write_file

HEADER = "Lateral units: m\nValue units: m"


def export_xyz(result: Result, folder: Path) -> list[Path]:
    """Write the surface of each body at the last save as lines of x, y and height, in m.

    Heights are outward from the body, less what was worn and what yielded. The units are in a
    header as Gwyddion writes it.

    Returns
    -------
    list of Path
        NAME.xyz of each body NAME.
    """
    x, y = np.broadcast_arrays(*result.grid.mesh)
    make_folder(folder)
    paths = []
    for name in result.body_names:
        path = folder / f"{name}.xyz"
        points = np.stack([x, y, result.body(name).surface(-1)], axis=-1).reshape(-1, 3)
        lines = BytesIO()
        np.savetxt(lines, points, fmt="%.9e", header=HEADER)
        write_file(path, lines.getbuffer())
        paths.append(path)
    return paths
