"""What keeps models that have one mistake each."""

import ast
import inspect
import sys

MISTAKES = {}
"""The class with each mistake, by what the mistake is."""


def square(array):
    """Return an array transposed, where that has the same shape, as in a square window."""
    turned = array.swapaxes(-1, -2)
    return turned if turned.shape == array.shape else array


def methods(source):
    """Return the methods of the class in a source, by name."""
    (tree,) = ast.parse(source).body
    return {each.name: each for each in tree.body if isinstance(each, ast.FunctionDef)}


def rewritten(honest, texts):
    """Return the methods of a class that differ once other texts stand in its source.

    `texts` are what stands there, or in a class it is made from, and what takes its place, in turn.
    """
    if not texts:
        return {}
    cls = next(each for each in honest.__mro__ if texts[0] in inspect.getsource(each))
    source = changed = inspect.getsource(cls)
    for old, new in zip(texts[::2], texts[1::2], strict=True):
        assert changed.count(old) == 1, f"{old!r} must stand once in {cls.__name__}"
        changed = changed.replace(old, new)
    before, parts = methods(source), {}
    for name, method in methods(changed).items():
        if ast.dump(method) != ast.dump(before[name]):
            names = {"square": square, **vars(sys.modules[cls.__module__])}
            exec(compile(ast.Module([method], []), f"<{name}>", "exec"), names, parts)
    return parts


def mistake(words, honest, *texts, **parts):
    """Keep a copy of an honest model with other texts in its source, or with other parts."""
    name = f"{honest.__name__}{len(MISTAKES)}"
    # Another process finds it by its name in the module that has them all.
    own = {"__module__": f"{__package__}.mistakes", "type": honest.type}
    MISTAKES[words] = type(name, (honest,), {**own, **rewritten(honest, texts), **parts})


def configuration(cls):
    """Return all numbers of a model, none of them its default."""
    return {k: 1.2 * v for k, v in cls().model_dump().items() if isinstance(v, float)}
