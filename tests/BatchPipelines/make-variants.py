#!/usr/bin/env python3
"""make-variants.py FOLDER COUNT PHANTOM...: writes COUNT NIfTI files into FOLDER, from compressed NIfTI files of rhombic phantom.

Each has one of the phantoms' sizes and one of the 48 orientations of axes, and every 20th, named broken-..., can't be read."""
import gzip
import itertools
import os
import random
import struct
import sys

folder, count, phantoms = sys.argv[1], int(sys.argv[2]), sys.argv[3:]
os.makedirs(folder)
orientations = list(itertools.product(itertools.permutations(range(3)), itertools.product((1, -1), repeat=3)))
volumes = [gzip.open(phantom).read() for phantom in phantoms]
generator = random.Random(7)
generator.shuffle(orientations)
for n in range(count):
    volume = bytearray(volumes[n % len(volumes)])
    axes, signs = orientations[n % len(orientations)]
    rows = [struct.unpack_from("<4f", volume, 280 + 16 * row) for row in range(3)]  # srow_x, srow_y, srow_z
    for row in range(3):
        struct.pack_into("<4f", volume, 280 + 16 * row, *(signs[row] * value for value in rows[axes[row]]))
    struct.pack_into("<hh", volume, 252, 0, 1)  # qform_code, sform_code
    volume[352 + n] ^= 1  # no two files are the same
    content = gzip.compress(bytes(volume), 1, mtime=0)
    name = f"variant-{n:03}.nii.gz"
    if n % 20 == 19:
        name = "broken-" + name
        damaged = bytearray(content)
        damaged[len(content) // 2] ^= 255
        content = [b"", content[: len(content) // 2], content[:10], bytes(damaged), b"text\n" * 100][n // 20 % 5]
    with open(os.path.join(folder, name), "wb") as file:
        file.write(content)
