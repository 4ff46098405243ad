"""Change a result file as tribo itself would, so that its checksums fit."""

from contextlib import closing, contextmanager

import h5py

from tribo.result.sealed_writer import SealedWriter


@contextmanager
def edited(path):
    """Give the open HDF5 file, and seal it again."""
    with closing(SealedWriter(path)) as sealed:
        with h5py.File(sealed, "r+", libver="earliest") as file:
            yield file
        sealed.commit(sync=True)
