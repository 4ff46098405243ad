"""Models as authors write them, each with one mistake from `mistakes/*.toml`.

By the model and what is wrong, a mistake is a text of the model and what stands in its place, or
the code of what is defined otherwise. What found each is in `docs/_data/mistakes.json`, which
`found.py` writes.
"""

import inspect
import os
import random
import tempfile
import time
import tomllib
import warnings
from itertools import count
from pathlib import Path
from textwrap import dedent

import numpy as np
from testing.conformance import honest_effects, honest_laws, honest_others

from tribo import Grid, Passing, Residuals

FOLDER = Path(__file__).with_name("mistakes")
HONEST = (*honest_laws.LAWS, *honest_effects.EFFECTS, *honest_others.OTHERS)
NUMBERS = count()


def square(array):
    """Return an array transposed, where that has the same shape, as in a square window."""
    turned = np.swapaxes(array, -1, -2)
    return turned if turned.shape == array.shape else array


def one_thread():
    os.environ["OMP_NUM_THREADS"] = "1" + os.environ.get("OMP_NUM_THREADS", "")


MORE = (os, random, tempfile, time, warnings, Grid, Passing, Residuals, square, one_thread)
NAMES = {
    **vars(honest_laws),
    **vars(honest_effects),
    **vars(honest_others),
    **{each.__name__: each for each in MORE},
    "NUMBERS": NUMBERS,
}
"""What the code of a mistake may name."""
MODELS = {model.__name__: model for model in HONEST}


def replaced(model, old, new):
    """Return the code of the method of a model with `old`, where `new` stands in its place."""
    own = [base for base in reversed(model.__mro__) if base.__module__.startswith(__package__)]
    methods = {name: part for base in own for name, part in vars(base).items()}
    functions = [getattr(method, "fget", method) for method in methods.values()]
    code = [dedent(inspect.getsource(each)) for each in functions if inspect.isfunction(each)]
    if sum(text.count(old) for text in code) != 1:
        raise ValueError(f"{old!r} must stand once in the methods of {model.__name__}")
    return next(text.replace(old, new.strip()) for text in code if old in text)


def copy_of(name, mistake):
    """Return a copy of a model with a mistake; another process finds it in this module."""
    model = MODELS[name]
    parts = {"__module__": __name__, "type": model.type}
    exec(mistake if isinstance(mistake, str) else replaced(model, *mistake), NAMES, parts)
    return type(f"{name}{next(NUMBERS)}", (model,), parts)


MISTAKES = {
    words: copy_of(model, mistake)
    for path in sorted(FOLDER.glob("*.toml"))
    for model, mistakes in tomllib.loads(path.read_text("utf-8")).items()
    for words, mistake in mistakes.items()
}
"""The class with each mistake, by what the mistake is."""
globals().update({cls.__name__: cls for cls in MISTAKES.values()})


def configuration(cls):
    """Return all numbers of a model, none of them its default."""
    return {k: 1.2 * v for k, v in cls().model_dump().items() if isinstance(v, float)}
