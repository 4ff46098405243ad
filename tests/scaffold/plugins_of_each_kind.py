"""A name for a plugin of every kind."""

NAMES = {
    "wear-law": "acme-fretting",
    "contact-solver": "acme-layered",
    "kinematics": "acme-shuttle",
    "surface": "acme-dome",
    "effect": "acme-heat",
    "observer": "acme-depth-watch",
}
