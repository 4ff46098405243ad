"""Small files as instruments write them."""

import struct

import numpy as np
import pytest

PIXELS = (72, 60)
SIZE = (0.864e-3, 0.9e-3)  # pixels of 12 × 15 µm


def _opd(path, heights, size):
    """A Wyko .opd: wavelengths as float32, x first, y from the top; bad pixels above 1e38."""
    nx, ny = heights.shape
    wavelength, mult = 600.0, 1  # nm
    raw = np.where(np.isfinite(heights), heights / (wavelength * 1e-9), 2e38)
    array = struct.pack("<3H", nx, ny, 4) + raw[:, ::-1].astype("<f4").tobytes()
    pixel = size[0] / nx
    blocks = [
        (b"RAW_DATA", 3, array),
        (b"Wavelength", 7, struct.pack("<f", wavelength)),
        (b"Mult", 6, struct.pack("<h", mult)),
        (b"Aspect", 7, struct.pack("<f", size[1] / ny / pixel)),
        (b"Pixel_size", 7, struct.pack("<f", 1e3 * pixel)),
    ]
    directory = struct.pack("<16shlH", b"Directory", 1, 24 * (len(blocks) + 1), 0)
    for name, kind, content in blocks:
        directory += struct.pack("<16shlH", name, kind, len(content), 0)
    path.write_bytes(b"\x01\x00" + directory + b"".join(content for _, _, content in blocks))


def _x3p(path, heights, size):
    from SurfaceTopography import Topography

    Topography(np.ma.masked_invalid(heights), size, unit="m").to_x3p(str(path))


def _asc(path, heights, size):
    """Gwyddion's text export: a line for each y."""
    lines = [
        "# Channel: Height",
        f"# Width: {1e3 * size[0]:.9g} mm",
        f"# Height: {1e3 * size[1]:.9g} mm",
        "# Value units: m",
    ]
    rows = (" ".join("nan" if np.isnan(h) else f"{h:.12e}" for h in row) for row in heights.T)
    path.write_text("\n".join([*lines, *rows]) + "\n")


def _npy(path, heights, size):
    np.save(path, heights)


WRITERS = {"opd": _opd, "x3p": _x3p, "asc": _asc, "npy": _npy}


@pytest.fixture(scope="session")
def heights():
    """A smooth random map on PIXELS, Sq 0.2 µm, waves of a tenth of the map and longer."""
    rng = np.random.default_rng(7)
    x = (np.arange(PIXELS[0]) + 0.5) / PIXELS[0]
    y = (np.arange(PIXELS[1]) + 0.5) / PIXELS[1]
    rough = np.zeros(PIXELS)
    for _ in range(40):
        u, v, phase = *rng.uniform(-8, 8, 2), rng.uniform(0, 2 * np.pi)
        rough += np.cos(2 * np.pi * (u * x[:, None] + v * y[None, :]) + phase)
    rough -= rough.mean()
    rough *= 0.2e-6 / rough.std()
    rough.flags.writeable = False
    return rough


@pytest.fixture
def write(tmp_path, heights):
    """Write a map in a format, `heights` on SIZE unless given, and return its path."""

    def writing(kind, values=heights, size=SIZE, name="scan"):
        path = tmp_path / f"{name}.{kind}"
        WRITERS[kind](path, values, size)
        return path

    return writing
