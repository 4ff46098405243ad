"""Files in and heights out: scale, orientation, holes, and what is refused."""

import zipfile

import numpy as np
import pytest
from tribo import CaseError, Grid, read_heights

import tribo_topography.read
from tribo_topography import MeasuredSurface, describe

# SurfaceTopography, at its first import.
pytestmark = pytest.mark.filterwarnings("ignore::ImportWarning")

SIZE = (0.864e-3, 0.9e-3)
PIXELS = (72, 60)
# An .npy file states no scale.
SCALE = {"npy": {"size": SIZE, "unit": "1 m"}}


def surface(path, **config):
    kind = path.suffix[1:]
    config = {"detrend": "none", "expect_within": 0.02, **SCALE.get(kind, {}), **config}
    return MeasuredSurface(path=path, **config)


def quiet(path, heights, **config):
    """A surface whose scale is confirmed, so that it warns of nothing."""
    config = {"expect_size": SIZE, "expect_range": np.ptp(heights), **config}
    return surface(path, **config)


@pytest.mark.parametrize("kind", ["opd", "x3p", "asc", "npy"])
@pytest.mark.slow
def test_scale_and_every_pixel_come_back_and_holes_are_filled_if_asked(write, heights, kind):
    holed = heights.copy()
    holed[20:22, 30:33] = holed[0, 0] = holed[-1, 20:23] = np.nan
    path = write(kind, holed)
    with pytest.raises(CaseError, match=r"lacks 10 of 4320 pixels \(0\.23 %\); set fill"):
        surface(path).height(Grid(SIZE, PIXELS))
    with pytest.raises(CaseError, match=r"more than max_missing = 0\.001"):
        surface(path, fill="interpolate", max_missing=1e-3).height(Grid(SIZE, PIXELS))
    measured = quiet(path, heights, fill="interpolate")
    facts = measured.scale
    assert (facts.format, facts.pixels) == (kind, PIXELS)
    # Sizes and heights are kept as float32 in .opd.
    assert facts.size == pytest.approx(SIZE, rel=1e-6)
    assert facts.range == pytest.approx(np.ptp(heights), rel=1e-5)
    assert facts.sq == pytest.approx(np.nanstd(holed), rel=1e-5)
    assert describe(measured) == facts
    values = measured.height(Grid(SIZE, PIXELS))
    there = np.isfinite(holed)
    np.testing.assert_allclose(values[there], heights[there], rtol=0, atol=2e-12)
    # Neighbours of these waves differ by a third of Sq.
    np.testing.assert_allclose(values, heights, rtol=0, atol=0.3e-6)
    if kind == "x3p":
        found = read_heights(path)
        np.testing.assert_allclose(found.heights, holed, rtol=0, atol=2e-12)
        assert found.pitch == pytest.approx(np.divide(SIZE, PIXELS), rel=1e-6)
        assert read_heights(path, (1e-6, 2e-6)).pitch == (1e-6, 2e-6)


def test_wrong_scale_is_caught(write, heights):
    path = write("opd")
    with pytest.raises(CaseError, match=r"0\.864 × 0\.9 mm, but expect_size says 0\.864 × 0\.45"):
        surface(path, expect_size=["0.864 mm", "0.45 mm"]).scale  # noqa: B018
    with pytest.raises(CaseError, match=r"range over .* µm, but expect_range says 0\.1 µm"):
        surface(path, expect_range="0.1 µm").scale  # noqa: B018
    corrected = quiet(path, 8 * heights, height_scale=8)
    assert corrected.scale.sq == pytest.approx(1.6e-6, rel=1e-5)
    half = quiet(path, heights, size=["1.728 mm", "1.8 mm"], expect_size=["1.728 mm", "1.8 mm"])
    assert half.scale.size == (1.728e-3, 1.8e-3)


@pytest.mark.parametrize(
    ("size", "factor"), [((160.0, 160.0), 1e-3), ((0.5e-6, 0.5e-6), 1e-3), (SIZE, 1e4)]
)
def test_absurd_scale_is_refused_unless_it_is_stated(write, heights, size, factor):
    path = write("x3p", factor * heights, size)
    with pytest.raises(CaseError, match="which is unlikely"):
        surface(path).scale  # noqa: B018
    stated = {"expect_size": size, "expect_range": factor * np.ptp(heights)}
    assert surface(path, **stated).scale.size == pytest.approx(size, rel=1e-6, abs=0)


def test_unconfirmed_scale_is_told_once_with_the_figures(write):
    measured = surface(write("opd"))
    told = r"scan.opd \(opd, 'RAW_DATA'\): 72 × 60 pixels on 0.864 × 0.9 mm, .* Sq 0.2 µm\. If"
    with pytest.warns(UserWarning, match=told):
        measured.height(Grid(SIZE, PIXELS))
    measured.height(Grid(SIZE, PIXELS))


def test_rotate_and_mirror_bring_the_lay_to_where_it_is_asked_for(write, heights):
    path = write("x3p")
    turned = {"expect_size": SIZE, "expect_range": np.ptp(heights), "detrend": "none"}
    across = Grid(SIZE[::-1], PIXELS[::-1])
    values = surface(path, **turned, rotate=90).height(across)
    # Anticlockwise: what lay at +x comes to +y, what lay at +y to −x.
    np.testing.assert_allclose(values[0, :], heights[:, -1], rtol=0, atol=1e-15)
    np.testing.assert_allclose(values[:, -1], heights[-1, ::-1], rtol=0, atol=1e-15)
    values = surface(path, **turned, mirror=True).height(Grid(SIZE, PIXELS))
    np.testing.assert_allclose(values, heights[:, ::-1], rtol=0, atol=1e-15)


def test_window_may_lie_off_the_middle_but_not_outside(write, heights):
    path = write("x3p")
    pixel = (SIZE[0] / 72, SIZE[1] / 60)
    window = Grid((24 * pixel[0], 20 * pixel[1]), (24, 20))
    moved = quiet(path, heights, centre=(12 * pixel[0], -10 * pixel[1])).height(window)
    np.testing.assert_allclose(moved, heights[36:60, 10:30], rtol=0, atol=1e-14)
    with pytest.raises(
        CaseError, match=r"window of 1 × 0\.8 mm reaches .* area of 0\.864 × 0\.9 mm"
    ):
        surface(path).height(Grid((1e-3, 0.8e-3), (64, 64)))
    with pytest.raises(CaseError, match=r"around 0.5, 0 mm .* or move centre"):
        surface(path, centre=("0.5 mm", 0)).height(window)


def test_cells_larger_than_pixels_hold_their_mean(write, heights):
    coarse = quiet(write("x3p"), heights).height(Grid(SIZE, (24, 20)))
    means = heights.reshape(24, 3, 20, 3).mean(axis=(1, 3))
    np.testing.assert_allclose(coarse, means, rtol=0, atol=1e-14)


def test_much_coarser_or_finer_cells_are_told(write, heights):
    path = write("x3p")
    with pytest.warns(UserWarning, match="averages 12 pixels"):
        quiet(path, heights).height(Grid(SIZE, (8, 5)))
    with pytest.warns(UserWarning, match="is 5 cells wide"):
        quiet(path, heights).height(Grid((SIZE[0] / 2, SIZE[1] / 2), (180, 150)))
    with pytest.raises(CaseError, match="4 pixels across are needed"):
        quiet(path, heights).height(Grid((40e-6, 40e-6), (16, 16)))


MISTAKES = [
    ("npy", {"size": None}, r"does not say how large the measured area is; .* add size"),
    ("npy", {"unit": None}, r"states no unit for its heights; .* add unit"),
    ("x3p", {"unit": "1 um"}, r"states its heights in m; leave unit out"),
    ("x3p", {"format": "x3q"}, r"no file format is called 'x3q'; there are .*x3p"),
    ("x3p", {"format": "opd"}, r"cannot be read as 'opd'"),
    ("x3p", {"channel": "Height"}, r"no channel 'Height'.* its channels are 0 'Default'"),
    ("x3p", {"channel": 3}, r"no channel 3"),
    ("x3p", {"height_scale": 0}, r"height_scale is 0"),
    ("x3p", {"sha256": "0" * 64}, r"is not the file that is meant: its SHA-256 is [0-9a-f]{64}"),
]


@pytest.mark.parametrize(("kind", "config", "message"), MISTAKES)
def test_mistake_is_one_line_that_says_what_to_do(write, kind, config, message):
    with pytest.raises(CaseError, match=message) as raised:
        surface(write(kind), **config).scale  # noqa: B018
    assert "\n" not in str(raised.value)
    assert len(str(raised.value)) < 400


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("notes.txt", b"nothing of a surface\n", "scan|notes"),
        ("scan.bin", bytes(range(256)) * 9, "in no format that is known"),
        ("scan.opd", b"not at all a Wyko file", "is broken"),
        ("scan.x3p", b"PK\x03\x04 and no more", "is broken"),
        ("scan.opd", b"1 2 3 4\n" * 4, "named as 'opd', but looks like 'asc' inside"),
        ("scan.opd", b"", "."),
    ],
)
def test_file_that_is_no_surface_is_one_line(tmp_path, name, content, message):
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(CaseError, match=message) as raised:
        describe(path)
    assert "\n" not in str(raised.value)
    assert len(str(raised.value)) < 400 + 2 * len(str(path))
    path.unlink()
    with pytest.raises(CaseError, match=f"no file {name} in .*, where tribo was started"):
        describe(name)


def test_truncated_file_is_an_error(write):
    for kind in ("opd", "x3p"):
        path = write(kind)
        path.write_bytes(path.read_bytes()[:-2000])
        with pytest.raises(CaseError, match=str(path)):
            describe(path)


class Trap:
    def __reduce__(self):
        return pytest.fail, ("a pickle was opened",)


def test_pickles_are_not_opened(tmp_path):
    path = tmp_path / "scan.npy"
    np.save(path, np.array([[Trap()] * 4] * 4, dtype=object), allow_pickle=True)
    with pytest.raises(CaseError):
        surface(path).scale  # noqa: B018
    archive = tmp_path / "scan.npz"
    with zipfile.ZipFile(archive, "w") as file:
        file.write(path, "scan.npy")
    with pytest.raises(CaseError):
        surface(archive, size=SIZE, unit=1).scale  # noqa: B018


def test_too_large_a_file_is_refused_before_it_is_read(write, tmp_path, monkeypatch):
    monkeypatch.setattr("tribo.core.number_tables.MOST_PIXELS", 4000)
    with pytest.raises(CaseError, match=r"72 × 60 pixels: .*4,000"):
        describe(write("x3p"))
    path = tmp_path / "packed.x3p"
    with (
        zipfile.ZipFile(write("x3p", np.zeros(PIXELS))) as loose,
        zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as packed,
    ):
        for name in loose.namelist():
            packed.writestr(name, loose.read(name))
    monkeypatch.setattr(tribo_topography.read, "MAX_BYTES", 20_000)
    assert path.stat().st_size < 20_000
    with pytest.raises(CaseError, match="MiB are read"):
        describe(path)
