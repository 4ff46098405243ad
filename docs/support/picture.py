"""Show a figure in an executed page."""

from __future__ import annotations

from io import BytesIO

import matplotlib.pyplot as plt
from IPython.display import Image
from matplotlib.figure import Figure

from tribo.plotting.style import house_style


def picture(figure: Figure, width: int = 620) -> Image:
    """Return a figure as an image, `width` pixels wide on the page."""
    data = BytesIO()
    with house_style():
        figure.savefig(data, format="png", dpi=200)
    # The notebook would show it a second time.
    plt.close(figure)
    return Image(data.getvalue(), width=width)
