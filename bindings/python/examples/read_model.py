"""Reads reduced models using only numpy and pcodec: python read_model.py MODEL.rom [MODEL.rom ...]

The format is described in the manual, page "Model files".
"""

import json
import struct
import sys
from math import comb

import numpy as np
from pcodec.standalone import simple_decompress

BINOMIALS = np.array([[(-1.0) ** i * comb(n, i) for i in range(6)] for n in range(6)])


def open_model(path):
    """Returns the directory of a model file, and a function that decodes an array by its name."""
    with open(path, "rb") as file:
        data = file.read()
    magic, version, _length, _hash, size = struct.unpack_from("<8sIQQQ", data)
    if (magic, version) != (b"EHLROM\r\n", 20):
        raise ValueError(f"{path} is no model file of version 20")
    directory = json.loads(data[36 : 36 + size])

    def array(name):
        entry = directory["arrays"][name]
        plain, shape = entry["codec"] == "pco", entry["shape"]
        lengths = [entry["bytes"]] if plain else entry["codec"]["multiples"]["parts"]
        ends = 36 + size + entry["offset"] + np.cumsum([0, *lengths])
        parts = [simple_decompress(data[begin:end]) for begin, end in zip(ends, ends[1:])]
        return (parts[0] if plain else multiples(parts, shape, entry["codec"]["multiples"]["across"])).reshape(shape)

    return directory, array


def multiples(parts, shape, across):
    """Decodes multiples of 2^(row + column), stored as differences from a polynomial through earlier nodes."""
    rows, row_classes = parts[0].astype(int).reshape(2, -1)
    columns, along, aside, classes = parts[1].astype(int).reshape(4, -1)
    used = np.flatnonzero(rows > -32768)
    differences = np.empty(len(parts[2]), dtype=np.int64)
    differences[np.argsort((classes[:, None] + row_classes[used]).ravel(), kind="stable")] = parts[2]
    along, aside = BINOMIALS[along], BINOMIALS[aside]
    terms = [(i, j, -along[:, i] * aside[:, j]) for i in range(6) for j in range(3) if i + j > 0]
    values = np.zeros((5 + shape[0] // across, 2 + across, shape[1]))
    for row, difference in zip(used, differences.reshape(shape[1], -1).T):
        x, y, step = 5 + row // across, 2 + row % across, np.ldexp(1.0, rows[row] + columns)
        count = sum((factor * values[x - i, y - j] for i, j, factor in terms), np.zeros(shape[1])) / step
        count = np.where(abs(count) < 2.0**62, np.rint(count), 0.0).astype(np.int64) + difference
        values[x, y] = step * count
    return values[5:, 2:]


def pressure_modes(directory, array, window=0):
    """Returns the pressure modes of a local model, nodes x modes."""
    own, shared = (name in directory["arrays"] for name in (f"windows/{window}/pressure", "shared/pressure"))
    if own:
        return array(f"windows/{window}/pressure")
    return array("shared/pressure" if shared else "windows/0/pressure") @ array(f"windows/{window}/factors")


if __name__ == "__main__":
    for path in sys.argv[1:]:
        directory, array = open_model(path)
        print(f"{directory['title']}: {' x '.join(map(str, pressure_modes(directory, array).shape))} pressure modes")
