"""A new plugin, as a complete distribution to start from."""

from tribo.scaffold.names import PluginName
from tribo.scaffold.write import write_plugin

__all__ = ["PluginName", "write_plugin"]
