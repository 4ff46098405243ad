"""Change a result file as tribo itself would, so that its checksum fits."""

from contextlib import contextmanager
from io import BytesIO

import h5py

from tribo.result.sealed import write_sealed


@contextmanager
def edited(path):
    """Give the open HDF5 file, and write its checksum again."""
    image = BytesIO(path.read_bytes())
    with h5py.File(image, "r+") as file:
        yield file
    write_sealed(path, image.getbuffer(), sync=False)
