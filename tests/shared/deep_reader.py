"""A reader of deep pictures and their flattening, of its own: numpy, and OpenEXR for the file."""

import numpy as np


def read(path):
    """The header, and by pixel an array of samples: red, green, blue, alpha, begin, end; from front to back as in the file."""
    import OpenEXR

    # What the file gives goes with it.
    with OpenEXR.File(str(path), separate_channels=True) as file:
        header = dict(file.header())
        channels = {name: channel.pixels.copy() for name, channel in file.channels().items()}
    assert header["type"] == OpenEXR.deepscanline
    assert set(channels) == {"R", "G", "B", "A", "Z", "ZBack"}
    columns = [channels[name] for name in ("R", "G", "B", "A", "Z", "ZBack")]
    pixels = np.empty(columns[0].shape, object)
    for place in np.ndindex(pixels.shape):
        values = [column[place] for column in columns]
        pixels[place] = np.zeros((0, 6)) if values[0] is None else np.stack(values, axis=-1).astype("f8")
    return header, pixels


def flatten(pixels, before=np.inf):
    """Colour and alpha of all samples that begin before a depth, laid over one another."""
    flat = np.zeros((*pixels.shape, 4))
    for place in np.ndindex(pixels.shape):
        left = 1.0
        for sample in pixels[place]:
            if sample[4] < before:
                flat[place] += left * sample[:4]
                left *= 1.0 - sample[3]
    return flat
