"""A lubricant film that carries part of the load, for tribo."""
