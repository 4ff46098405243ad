"""What this package offers to tribo."""
