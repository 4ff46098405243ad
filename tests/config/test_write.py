"""Tables are read back as they were written."""

import tomllib

from hypothesis import given
from hypothesis import strategies as st

from tribo.core.toml import to_toml

KEYS = st.text(st.characters(codec="utf-8"), max_size=6)
NUMBERS = st.integers(-(2**63), 2**63 - 1) | st.floats(allow_nan=False)
VALUES = st.recursive(
    st.booleans() | NUMBERS | st.text(st.characters(codec="utf-8")),
    lambda inside: st.lists(inside, max_size=3) | st.dictionaries(KEYS, inside, max_size=3),
    max_leaves=8,
)


@given(st.dictionaries(KEYS, VALUES, max_size=4))
def test_what_is_written_is_read_back(tables):
    assert tomllib.loads(to_toml(tables)) == tables


def test_what_is_not_given_is_left_out():
    assert to_toml({"load": {"normal": 1.0, "other": None}}) == "[load]\nnormal = 1.0\n"
