"""A new plugin, as a complete distribution to start from."""

from tribo.scaffold.names import plugin_names
from tribo.scaffold.write import write_plugin

__all__ = ["plugin_names", "write_plugin"]
