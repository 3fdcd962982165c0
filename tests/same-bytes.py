#!/usr/bin/env python3
"""same-bytes.py FOLDER: rewrites the outputs of rhombic in FOLDER so that two runs of one command are the same bytes, for same-bytes.sh.

Left out are times, memory, and how a command was given, which is
  in reports and results (.json, .jsonl): "arguments", "settings", "command", "options"; of files that hold them, also size and MD5,
  in pictures: the description (PNG "Description"; "ImageDescription" of JPEG, TIFF; "comments" of EXR; IPTC of both),
  in tables of a batch: seconds, peak_MiB, and size and MD5 of files that hold a description.
All else stays: pixels as they are encoded, other metadata, other fields in their order.

same-bytes.py --probabilities LABELS VALUE...: writes VALUE.nii.gz, a soft mask of each of these labels of an 8-bit NIfTI file.
"""

import gzip
import hashlib
import json
import os
import re
import struct
import sys

DESCRIBED = {"page", "picture", "report", "thumbnail"}  # kinds of files that hold how the command was given
UNSTEADY = {"arguments", "settings", "command", "options", "seconds", "peakMemory", "stamp"}


def json_without_runs(value):
    if isinstance(value, list):
        return [json_without_runs(item) for item in value]
    if not isinstance(value, dict):
        return value
    unsteady = UNSTEADY | ({"bytes", "md5"} if str(value.get("kind")) in DESCRIBED else set())
    return {key: json_without_runs(item) for key, item in value.items() if key not in unsteady}


def normal_json(text):
    """Numbers keep their digits."""
    return json.dumps(json_without_runs(json.loads(text, parse_float=str, parse_int=str)), indent=1)


def normal_lines(text):
    """A journal: cases end in any order."""
    return "\n".join(sorted(normal_json(line) for line in text.splitlines()))


def normal_table(text):
    rows = [line.split("\t") for line in text.splitlines()]
    header = rows[0]
    for row in rows[1:]:
        for column, cell in enumerate(row):
            name = header[column]
            isDescribed = "kind" in header and row[header.index("kind")] in DESCRIBED
            if name in ("seconds", "peak_MiB") or (name in ("size_bytes", "md5") and isDescribed):
                row[column] = "*"
            elif name == "steps":
                row[column] = re.sub(r"=[0-9.]+s", "=*s", cell)
    return "\n".join("\t".join(row) for row in rows)


def normal_text(text):
    """What is printed: times, memory, and the order in which cases of a batch ended."""
    text = re.sub(r"[0-9.]+ (GiB|MiB|s|min)\b", r"* \1", text)
    text = re.sub(r'(<td class="number">)[0-9.]+', r"\1*", text)
    text = re.sub(r"(\t(?:done|failed|missing|changed)\t[0-9.]+)\t[0-9.]+\t[0-9]+$", r"\1\t*\t*", text, flags=re.M)
    ended = r"(?:[\w.-]+: (?:done|failed).*\n)+"
    return re.sub(ended, lambda cases: "".join(sorted(cases.group().splitlines(True))), text)


def normal_png(data):
    kept, place = [data[:8]], 8
    while place < len(data):
        (size,) = struct.unpack_from(">I", data, place)
        chunk = data[place : place + size + 12]
        if not chunk[4:].startswith((b"tEXtDescription\0", b"zTXtDescription\0", b"iTXtDescription\0")):
            kept.append(chunk)
        place += size + 12
    return b"".join(kept)


def tiff_tags(data):
    """The tags of all directories of a TIFF file or EXIF block, but for descriptions and places; strips as a digest."""
    order = "<" if data[:2] == b"II" else ">"
    sizes = {1: 1, 2: 1, 3: 2, 4: 4, 5: 8, 6: 1, 7: 1, 8: 2, 9: 4, 10: 8, 11: 4, 12: 8, 13: 4}
    lines, directories = [], list(struct.unpack_from(order + "I", data, 4))
    while directories:
        place = directories.pop(0)
        if place == 0:
            continue
        (count,) = struct.unpack_from(order + "H", data, place)
        numbers = {}
        for entry in range(place + 2, place + 2 + 12 * count, 12):
            tag, kind, length = struct.unpack_from(order + "HHI", data, entry)
            size = sizes[kind] * length
            start = entry + 8 if size <= 4 else struct.unpack_from(order + "I", data, entry + 8)[0]
            value = data[start : start + size]
            if kind in (3, 4, 13):
                numbers[tag] = struct.unpack(order + str(length) + ("H" if kind == 3 else "I"), value)
            if tag in (0x8769, 0x8825):  # directories of EXIF and GPS
                directories.append(numbers[tag][0])
            elif tag not in (0x010E, 0x0111, 0x83BB, 0x02BC):  # description, places of strips, IPTC, XMP
                lines.append(f"{tag:04x} {kind} {value!r}")
        for start, size in zip(numbers.get(0x0111, ()), numbers.get(0x0117, ())):
            lines.append("strip " + hashlib.md5(data[start : start + size]).hexdigest())
        directories.append(struct.unpack_from(order + "I", data, place + 2 + 12 * count)[0])
    return "\n".join(lines).encode()


def normal_jpeg(data):
    kept, place = [data[:2]], 2
    while data[place + 1] != 0xDA:  # start of the scan
        (size,) = struct.unpack_from(">H", data, place + 2)
        segment = data[place : place + 2 + size]
        if segment[4:10] == b"Exif\0\0":
            kept.append(tiff_tags(segment[10:]))
        elif segment[1] not in (0xFE, 0xED) and b"ns.adobe.com/xap" not in segment:  # comment, IPTC, XMP
            kept.append(segment)
        place += 2 + size
    return b"".join(kept) + data[place:]


def normal_exr(data):
    kept, place, rows, rowsOfBlock = [data[:8]], 8, 0, 16
    while data[place] != 0:
        name, kind = data[place:].split(b"\0", 2)[:2]
        start = place + len(name) + len(kind) + 2
        (size,) = struct.unpack_from("<i", data, start)
        if name == b"dataWindow":
            _, first, _, last = struct.unpack_from("<4i", data, start + 4)
            rows = last - first + 1
        if name != b"comments":
            kept.append(data[place : start + 4 + size])
        place = start + 4 + size
    blocks = (rows + rowsOfBlock - 1) // rowsOfBlock  # their places follow, which depend on the description's length
    return b"".join(kept) + data[place + 1 + 8 * blocks :]


TEXTS = {".json": normal_json, ".jsonl": normal_lines, ".tsv": normal_table, ".html": normal_text, "": normal_text}
PICTURES = {".png": normal_png, ".jpg": normal_jpeg, ".tif": tiff_tags, ".exr": normal_exr}


def normalise(path):
    name = os.path.basename(path)
    extension = os.path.splitext(path)[1]
    with open(path, "rb") as file:
        data = file.read()
    if name in ("stdout", "stderr"):
        extension = ""
    elif extension == "":
        return
    if not data:
        return
    if extension in TEXTS:
        data = TEXTS[extension](data.decode()).encode()
    elif extension in PICTURES:
        data = PICTURES[extension](data)
    else:
        return
    with open(path, "wb") as file:
        file.write(data)


def write_probabilities(labelMap, values):
    """A voxel's probability is the share of label voxels among itself and its two neighbours along x."""
    data = gzip.open(labelMap).read()
    header, voxels = bytearray(data[:352]), data[352:]
    for value in values:
        isLabel = bytes(voxel == int(value) for voxel in voxels)
        shares = [(a + 2 * b + c) / 4 for a, b, c in zip(isLabel[-1:] + isLabel, isLabel, isLabel[1:] + isLabel[:1])]
        struct.pack_into("<hh", header, 70, 16, 32)  # float32
        with open(value + ".nii.gz", "wb") as file:
            file.write(gzip.compress(bytes(header) + struct.pack(f"<{len(shares)}f", *shares), mtime=0))


if sys.argv[1] == "--probabilities":
    write_probabilities(sys.argv[2], sys.argv[3:])
else:
    for folder, _, names in os.walk(sys.argv[1]):
        for name in names:
            normalise(os.path.join(folder, name))
