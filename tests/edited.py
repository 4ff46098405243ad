"""Look at the bytes of a result file, and change one so that its checksum fits."""

from contextlib import contextmanager
from io import BytesIO

import h5py

from tribo.result.sealed import write_sealed


def bits(result):
    """Return the bytes of every variable of a result, read without xarray."""
    return {name: values[()].tobytes() for name, values in result._kept.items() if name != "body"}


@contextmanager
def edited(path):
    """Give the open HDF5 file, and write its checksum again."""
    image = BytesIO(path.read_bytes())
    with h5py.File(image, "r+") as file:
        yield file
    write_sealed(path, image.getbuffer())
