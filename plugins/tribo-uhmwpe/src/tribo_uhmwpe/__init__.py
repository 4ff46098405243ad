"""Wear of polyethylene under cross-shear, for tribo."""
