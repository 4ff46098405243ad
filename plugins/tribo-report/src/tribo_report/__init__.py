"""Reports to hand on: one HTML file that opens anywhere, offline.

The page is filled in by Jinja2. Its charts are drawn by Plotly, whose script takes 2 MB of the
file, and which alone of its kind turns a surface in 3-D. On paper, and where no script may run, as
in the preview of some mail programs, the page shows the pictures of ``tribo plot`` instead.
"""

from tribo.kernel_api import lazy

__getattr__ = lazy(__name__, __file__)
