"""The abstract classes a plugin implements."""
