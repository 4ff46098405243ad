"""What packages may use of the kernel beside the names of `tribo`.

A model needs only the names of `tribo`. A job beside the kernel needs more: to step through a
run, to write files, tables and pictures in the house style, to add a command. It finds that here;
what lies in other modules may change with any version. Names are imported when first used;
``kernel_api.pyi`` lists them.
"""

from tribo.core.lazy import lazy

__getattr__ = lazy(__name__, __file__)
