"""A run as an animation: the pressure and the wear depth of each body, a frame a saved time."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path

import numpy as np
from PIL import Image

from tribo.core.writing import make_folder, write_file
from tribo.lab.scar import removed, scar_mask
from tribo.lab.units import time_labels
from tribo.plotting.maps import Scale, field_picture
from tribo.plotting.picture import NothingToDraw, Picture, below_each_other
from tribo.plotting.sections import varying
from tribo.result.read import Result

FRAME = 500
"""Time that a frame is shown, in ms: long enough to read the time above it."""


def save_animation(result: Result, path: Path) -> Path:
    """Write a GIF of the pressure and of the depths of the bodies that wear unevenly.

    All frames have one scale, up to the largest value after the beginning. `NothingToDraw` if all
    is uniform, `OutputError` if it cannot be written.
    """
    labels = time_labels(result.times)
    frames: list[list[Picture]] = [[] for _ in labels]
    for name in ("", *result.body_names):
        if name:
            fields = removed(result, name)
        else:
            fields = np.array([result.field("pressure", save) for save in range(len(labels))])
        marked = np.any([scar_mask(field) for field in fields], axis=0)
        most = float(np.max(fields[-len(labels) + 1 :]))
        scale = Scale.of(name, most)._replace(most=most)
        if vary := varying(list(fields), marked):
            for frame, field, label in zip(frames, fields, labels, strict=True):
                given = field, marked, result.grid, scale, f"t = {label}"
                frame.append(field_picture(*given, vary=vary))
    if not frames[0]:
        raise NothingToDraw("the pressure and the wear are uniform; there is nothing to animate")
    images = [_image(below_each_other(frame)) for frame in frames]
    data = BytesIO()
    images[0].save(data, "GIF", save_all=True, append_images=images[1:], duration=FRAME, loop=0)
    make_folder(path.parent)
    write_file(path, data.getbuffer())
    return path


def _image(picture: Picture) -> Image.Image:
    data = BytesIO()
    picture.figure().savefig(data, format="png")
    return Image.open(data).convert("RGB").quantize()
