"""Fretting: partial slip in a contact, and wear by the slip, for tribo."""
