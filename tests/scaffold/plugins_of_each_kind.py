"""A name for a plugin of every kind, in the order of the kinds."""

NAMES = {
    "contact-solver": "acme-layered",
    "wear-law": "acme-fretting",
    "kinematics": "acme-shuttle",
    "surface": "acme-dome",
    "effect": "acme-heat",
    "observer": "acme-depth-watch",
}
