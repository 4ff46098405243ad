"""Frictional heating, and wear laws that follow the temperature, for tribo."""
