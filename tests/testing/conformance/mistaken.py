"""What keeps models that have one mistake each."""

MISTAKES = {}
"""The class with each mistake, by what the mistake is."""


def mistake(words, honest, **parts):
    """Keep a copy of an honest model of which some parts are wrong."""
    name = f"{honest.__name__}{len(MISTAKES)}"
    # Another process finds it by its name in the module that has them all.
    where = f"{__package__}.mistakes"
    own = {"__module__": where, "type": honest.type, **parts}
    MISTAKES[words] = type(name, (honest,), own)


def configuration(cls):
    """Return all numbers of a model, none of them its default."""
    return {k: 1.2 * v for k, v in cls().model_dump().items() if isinstance(v, float)}
