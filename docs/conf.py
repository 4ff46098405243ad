"""How Sphinx builds these pages; every page that shows output is executed."""

from __future__ import annotations

import os
import re
import shutil
import sys
from importlib import metadata
from pathlib import Path
from tempfile import gettempdir

from sphinx.application import Sphinx

DOCS = Path(__file__).parent
sys.path.insert(0, str(DOCS / "support"))
sys.path.insert(0, str(DOCS.parent))
os.environ["TRIBO_REPOSITORY"] = str(DOCS.parent)

import reference  # noqa: E402
import speed  # noqa: E402

# The kernels that execute the pages see what this process sees.
os.environ["PYTHONPATH"] = os.pathsep.join(
    [str(DOCS / "support"), str(DOCS.parent / "examples"), str(DOCS.parent)]
)
# Cells show their figures as in a notebook, whatever draws outside.
os.environ["MPLBACKEND"] = "module://matplotlib_inline.backend_inline"
os.environ.setdefault("MPLCONFIGDIR", str(Path(gettempdir()) / "tribo-docs-matplotlib"))

project = "tribo"
author = "The tribo developers"
project_copyright = "The tribo developers"
try:
    release = metadata.version("tribo")
except metadata.PackageNotFoundError:
    release = ""

extensions = [
    "mathml",
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.doctest",
    "sphinx.ext.napoleon",
    "sphinx.ext.viewcode",
]
exclude_patterns = ["_build", "_generated", "**/.ipynb_checkpoints"]
default_role = "code"

html_theme = "furo"
html_math_renderer = "mathml"
html_title = "tribo"
html_static_path = ["static"]
html_css_files = ["tribo.css"]
html_copy_source = False
html_show_sourcelink = False

myst_enable_extensions = ["dollarmath", "amsmath", "deflist", "colon_fence"]
myst_heading_anchors = 3

doctest_global_setup = "import numpy as np\nimport tribo"

# The doctest builder needs no executed pages.
nb_execution_mode = "off" if "doctest" in sys.argv else "force"
suppress_warnings = ["myst-nb.lexer"] if nb_execution_mode == "off" else []
nb_execution_in_temp = True
nb_execution_raise_on_error = True
nb_execution_timeout = 600
nb_merge_streams = True
nb_render_markdown_format = "gfm"

autodoc_member_order = "bysource"
autodoc_typehints = "none"
napoleon_google_docstring = False
napoleon_use_rtype = False


def setup(app: Sphinx) -> None:
    """Write the reference pages anew, and bring those of packages, before anything is read."""
    app.connect("builder-inited", _refuse_old_figures)
    app.connect("builder-inited", lambda _: _prepare())
    app.connect("source-read", _link_within_the_site)


def _refuse_old_figures(app: Sphinx) -> None:
    shown = app.config.nb_execution_mode != "off"
    if shown and (message := speed.outdated(DOCS.parent)):
        raise SystemExit(message)


def _prepare() -> None:
    reference.write(DOCS / "_generated")
    for pages in (DOCS.parent / "plugins").glob("*/docs"):
        shutil.copytree(pages, DOCS, dirs_exist_ok=True)
    shutil.copytree(DOCS.parent / "examples" / "notebooks", DOCS / "notebooks", dirs_exist_ok=True)


def _link_within_the_site(app: Sphinx, page: str, source: list[str]) -> None:
    """Pages link by the paths of the repository; `_prepare` brings those files together."""
    top = "../" * page.count("/")
    elsewhere = r"(?:plugins/)?[\w-]+/docs|docs|examples(?=/notebooks/)"
    source[0] = re.sub(rf"\]\((?:\.\./)+(?:{elsewhere})/", f"]({top}", source[0])
