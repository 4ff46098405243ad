"""Reports to hand on: one HTML file that opens anywhere, offline.

The page is filled in by Jinja2. Its charts are drawn by Plotly, whose Python package carries the
whole script: 4.8 MB, of which 2 MB are left once it is compressed into the file. Of the libraries
that a Python package carries, it alone turns a surface in 3-D: Bokeh (about 1 MB compressed),
Vega-Lite and ECharts have flat charts only, and Plotly's smaller bundles are not on PyPI. On
paper, and where no script may run, as in the preview of some mail programs, the page shows the
pictures of ``tribo plot`` instead.
"""

from tribo.kernel_api import lazy

__getattr__ = lazy(__name__, __file__)
