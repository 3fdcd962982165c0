"""What the bytes of a file say, read by the formats' definitions alone, without code of the project: for malformed.py.

check() tells where an answer of rhombicReadMutants is another one. Numbers may differ by their rounding to 32 bits."""

import json
import math
import os
import re
import struct
import unicodedata
import xml.etree.ElementTree
import zlib

import yaml


def single(number):
    """Rounded to 32 bits."""
    try:
        return struct.unpack("f", struct.pack("f", number))[0]
    except OverflowError:
        return math.copysign(math.inf, number)


def is_near(a, b, size=0.0):
    return a == b or not (math.isfinite(a) or math.isfinite(b)) or math.isclose(a, b, rel_tol=2e-6, abs_tol=max(1e-12, 1e-9 * size))


def compare(numbers, expected, what, size=0.0):
    if len(numbers) != len(expected):
        return f"{len(numbers)} {what}, where the bytes say {len(expected)}"
    for place, (a, b) in enumerate(zip(numbers, expected)):
        if not is_near(a, b, size):
            return f"{what} {place} is {a}, where the bytes say {b}"
    return ""


def parse_scan(answer):
    head, rest = answer.split(" values")
    numbers = [float(word) for word in head.split()[1:]]
    values, layers = rest.split(" layers ")
    return ([int(n) for n in numbers[:3]], [numbers[3 + 3 * n:6 + 3 * n] for n in range(4)], [float(word) for word in values.split()],
            int(layers.split()[0]))


def check_volume(answer, size, origin, steps, values):
    read_size, points, read_values, _ = parse_scan(answer)
    if read_size != list(size):
        return f"size {read_size}, where the bytes say {size}"
    finite = [value for value in values if math.isfinite(value)]
    values = [value if math.isfinite(value) else min(finite) for value in values]
    largest = max(abs(c) for point in points for c in point)
    expected = [list(origin)] + [[o + s for o, s in zip(origin, step)] for step in steps]
    return (compare(sum(points, []), sum(expected, []), "coordinate", largest) or
            compare(read_values, [single(v) if abs(v) > 1 << 24 else v for v in values][:4096], "value"))


def unpacked(data):
    """All members of a gzip file; what follows them is left out, as gzip does."""
    found = b""
    while data[:2] == b"\x1f\x8b":
        packer = zlib.decompressobj(31)
        found += packer.decompress(data)
        assert packer.eof, "the stream has no end"
        data = packer.unused_data
    return found


NIFTI_TYPES = {2: "B", 4: "h", 8: "i", 16: "f", 64: "d", 256: "b", 512: "H", 768: "I", 1024: "q", 1280: "Q"}


def check_nifti(data, answer):
    order = "<" if struct.unpack_from("<i", data)[0] == 348 else ">"

    def get(fmt, at):
        found = struct.unpack_from(order + fmt, data, at)
        return found if len(found) > 1 else found[0]
    assert get("i", 0) == 348 and data[344:348] == b"n+1\0", "no NIfTI"
    count, dim = get("h", 40), get("7h", 42)
    size, volumes = dim[:3], math.prod(dim[3:count])
    fmt = NIFTI_TYPES[get("h", 70)]
    total = math.prod(size)
    assert 3 <= count <= 7 and volumes == 1 and min(size) > 0
    values = struct.unpack_from(f"{order}{total}{fmt}", data, int(get("f", 108)))
    values = [single(value) for value in values] if fmt == "d" else values
    slope, intercept = get("f", 112), get("f", 116)
    if slope != 0 and not math.isnan(slope):
        values = [single(slope * value + intercept) if math.isfinite(value) else value for value in values]
    pixdim = get("8f", 76)
    if get("h", 254) > 0:
        rows = [get("4f", 280 + 16 * row) for row in range(3)]
    elif get("h", 252) > 0:
        b, c, d = get("3f", 256)
        a = math.sqrt(max(0.0, 1 - b * b - c * c - d * d))
        length = math.sqrt(a * a + b * b + c * c + d * d)
        a, b, c, d = (n / length for n in (a, b, c, d))
        turn = [[a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
                [2 * (b * c + a * d), a * a + c * c - b * b - d * d, 2 * (c * d - a * b)],
                [2 * (b * d - a * c), 2 * (c * d + a * b), a * a + d * d - b * b - c * c]]
        sizes = [pixdim[1], pixdim[2], pixdim[3] * (-1 if pixdim[0] < 0 else 1)]
        rows = [[turn[row][axis] * sizes[axis] for axis in range(3)] + [get("f", 268 + 4 * row)] for row in range(3)]
    else:
        rows = [[-pixdim[1], 0, 0, 0], [0, -pixdim[2], 0, 0], [0, 0, pixdim[3], 0]]
    unit = {1: 1000, 3: 0.001}.get(get("B", 123) & 7, 1)
    rows = [[(-n if row < 2 else n) * unit for n in rows[row]] for row in range(3)]  # RAS to LPS
    return check_volume(answer, size, [row[3] for row in rows], [[row[axis] for row in rows] for axis in range(3)], values)


NRRD_TYPES = {"short": "h", "uchar": "B", "float": "f", "int16": "h", "uint8": "B"}


def check_nrrd(data, answer):
    head = re.match(rb"NRRD000[1-6][^\n]*\n(.*?\n)??\r?\n", data, re.S)
    text = (head.group() if head else data).decode("utf-8", "replace")
    fields = {}
    for line in text.split("\n")[1:]:
        if not line.startswith("#") and ": " in line + " " and ":=" not in line:
            key, value = line.split(":", 1)
            fields[key.lower().replace(" ", "")] = value.strip()
    fmt = NRRD_TYPES[fields["type"].lower()]
    sizes = [int(word) for word in re.findall(r"[^,\s()]+", fields["sizes"])]
    skip = int(float(fields.get("byteskip") or 0))
    voxels = data[len(head.group()) if head else len(data):]
    for _ in range(int(fields.get("lineskip") or 0)):
        voxels = voxels.split(b"\n", 1)[1]
    if fields["encoding"].lower() in ("gzip", "gz"):
        voxels = zlib.decompressobj(31).decompress(voxels)
    total, order = math.prod(sizes), "<" if fields.get("endian", "little").lower() == "little" else ">"
    assert len(sizes) == 3 and int(fields["dimension"]) == 3
    if skip < 0:
        skip = len(voxels) - total * struct.calcsize(fmt)
    values = struct.unpack_from(f"{order}{total}{fmt}", voxels, skip)
    unit = {"mm": 1.0, "um": 1e-3, "cm": 10.0, "m": 1e3}.get(fields.get("spaceunits", "").replace('"', "").split(" ")[0], 1.0)
    steps = [[unit * float(n) for n in re.findall(r"[^,\s()]+", vector)]
             for vector in re.findall(r"\(([^)]*)\)", fields.get("spacedirections", ""))]
    origin = [unit * float(n) for n in re.findall(r"[^,\s()]+", fields.get("spaceorigin", ""))] or [0.0] * 3
    if not steps:
        origin, spacings = [0.0] * 3, [unit * float(n) for n in fields.get("spacings", "1 1 1").split()]
        steps = [[spacings[axis] if row == axis else 0.0 for row in range(3)] for axis in range(3)]
    else:
        signs = {"ras": (-1, -1), "right-anterior-superior": (-1, -1), "las": (1, -1), "left-anterior-superior": (1, -1)}
        x, y = signs.get(fields.get("space", "").lower(), (1, 1))
        origin, *steps = ([x * v[0], y * v[1], v[2]] for v in [origin, *steps])
    return check_volume(answer, sizes, origin, steps, values)


META_TYPES = {"MET_SHORT": "h", "MET_UCHAR": "B", "MET_CHAR": "b", "MET_USHORT": "H", "MET_INT": "i", "MET_UINT": "I", "MET_FLOAT": "f",
              "MET_DOUBLE": "d", "MET_LONG": "i", "MET_ULONG": "I"}


def check_metaimage(data, answer):
    place = re.search(rb"(^|\n)\s*ElementDataFile\s*=\s*local[ \t\r]*\n", data, re.I)
    end = place.end()
    fields = {}
    for line in data[:end].decode("utf-8", "replace").split("\n"):
        if "=" in line:
            key, value = (part.strip() for part in line.split("=", 1))
            assert fields.get(key, value) == value, f"{key} is there twice, with other values"
            fields[key] = value
    sizes = [int(float(n)) for n in fields["DimSize"].replace(",", " ").split()]
    assert len(sizes) == 3 == int(fields["NDims"])
    is_big = (fields.get("BinaryDataByteOrderMSB") or fields.get("ElementByteOrderMSB") or "F")[0] in "Tt1"
    skip = int(float(fields.get("HeaderSize", "0")))
    fmt, total = META_TYPES[fields["ElementType"]], math.prod(sizes)
    voxels = data[end:]
    if (fields.get("CompressedData") or "F")[0] in "Tt1":
        voxels = zlib.decompressobj().decompress(voxels)
    elif skip > 0:
        voxels = data[skip:]
    elif skip < 0:
        voxels = data[len(data) - total * struct.calcsize(fmt):]
    values = struct.unpack_from(f"{'>' if is_big else '<'}{total}{fmt}", voxels)

    def numbers(*keys):
        text = next((fields[key] for key in keys if key in fields), "")
        return [float(word) for word in re.findall(r"[^,\s()]+", text)]
    spacing = numbers("ElementSpacing") or [1.0] * 3
    unit = {"um": 1e-3, "cm": 10.0}.get(fields.get("DistanceUnits", ""), 1.0)
    matrix = numbers("TransformMatrix", "Rotation", "Orientation") or [1, 0, 0, 0, 1, 0, 0, 0, 1]
    steps = [[unit * spacing[axis] * matrix[3 * axis + row] for row in range(3)] for axis in range(3)]
    origin = [unit * n for n in numbers("Offset", "Position", "Origin") or [0.0] * 3]
    return check_volume(answer, sizes, origin, steps, values)


def dicom_elements(data, begin=132, end=None):
    """Values by tags, in explicit little endian."""
    found, end = {}, len(data) if end is None else end
    while begin + 8 <= end:
        group, number = struct.unpack_from("<HH", data, begin)
        kind = data[begin + 4:begin + 6]
        is_long = kind in (b"OB", b"OW", b"OF", b"OD", b"SQ", b"UN", b"UT", b"UC", b"UR", b"OL", b"OV", b"SV", b"UV")
        length = struct.unpack_from("<I" if is_long else "<H", data, begin + (8 if is_long else 6))[0]
        begin += 12 if is_long else 8
        value = data[begin:begin + length]
        if (length == 0xFFFFFFFF or begin + length > end) and 0x7FE00010 in found:
            break  # padding
        if length == 0xFFFFFFFF or begin + length > end:
            raise ValueError("a length is beyond the end")
        tag = group << 16 | number
        found.setdefault(tag, []).append(value)
        begin += length
    return found


def dicom_items(data):
    begin = 0
    while begin + 8 <= len(data):
        length = struct.unpack_from("<I", data, begin + 4)[0]
        yield dicom_elements(data, begin + 8, begin + 8 + length)
        begin += 8 + length


def numbers_of(elements, tag, default=None):
    if tag not in elements and default is not None:
        return default
    return [float(word.strip(b" \0")) for word in elements[tag][0].split(b"\\")]


def slice_of(data):
    """Position, steps along rows and columns, and values of a slice; None when it is none."""
    try:
        elements = dicom_elements(data)
        short = {tag: struct.unpack("<H", elements[tag][0][:2])[0] for tag in (0x280010, 0x280011, 0x280100, 0x280101)}
        for tag, default in ((0x280102, short[0x280101] - 1), (0x280103, 0)):  # as other readers take them
            short[tag] = struct.unpack("<H", elements[tag][0][:2])[0] if tag in elements else default
        rows, columns, allocated, stored, high = short[0x280010], short[0x280011], short[0x280100], short[0x280101], short[0x280102]
        turn, spacing = numbers_of(elements, 0x200037), numbers_of(elements, 0x280030)
        position = numbers_of(elements, 0x200032)
        if len(position) != 3:
            return None
        pixels = elements[0x7FE00010][0]
        codes = struct.unpack_from(f"<{rows * columns}{'H' if allocated == 16 else 'B' if allocated == 8 else 'I'}", pixels)
        scaling = [tag for tag in (0x281053, 0x281052) if tag in elements and elements[tag][0].strip()]
        slope, intercept = (numbers_of(elements, tag)[0] if tag in scaling else absent for tag, absent in ((0x281053, 1.0), (0x281052, 0.0)))
        values = []
        for code in codes:
            code = code >> (high + 1 - stored) & (1 << stored) - 1
            code -= 1 << stored if short[0x280103] == 1 and code >> stored - 1 else 0
            values.append(single(slope * code + intercept))
        return {"position": position, "row": [n * spacing[1] for n in turn[:3]], "column": [n * spacing[0] for n in turn[3:]],
                "size": [columns, rows], "values": values, "elements": elements}
    except (ValueError, KeyError, struct.error, IndexError):
        return None


def check_series(path, answer):
    """Each slice that was read is one of the files, where it says, and no two are the same file."""
    files = [open(os.path.join(path, name), "rb").read() for name in sorted(os.listdir(path))]
    slices = [found for found in map(slice_of, files) if found]
    size, points, values, _ = parse_scan(answer)
    origin, steps = points[0], [[b - a for a, b in zip(points[0], point)] for point in points[1:]]
    used = set()
    for z in range(size[2]):
        place = [o + z * s for o, s in zip(origin, steps[2])]
        wanted = values[z * size[0] * size[1]:(z + 1) * size[0] * size[1]]
        for n, found in enumerate(slices):
            is_here = (n not in used and found["size"] == size[:2] and math.dist(found["position"], place) < 0.011 and
                       math.dist(found["row"], steps[0]) < 0.011 and math.dist(found["column"], steps[1]) < 0.011)
            if is_here and not compare(wanted, found["values"], "value"):
                used.add(n)
                break
        else:
            return f"slice {z} at {place} is in no file: {[(s['position'], s['row'], s['column'], s['size']) for s in slices]}"
    return ""


def check_segmentation(data, answer):
    elements = dicom_elements(data)
    size, points, values, layers = parse_scan(answer)
    rows, columns = (struct.unpack("<H", elements[tag][0][:2])[0] for tag in (0x280010, 0x280011))
    bits = elements[0x7FE00010][0]
    shared = next(dicom_items(elements[0x52009229][0]))
    turn = numbers_of(next(dicom_items(shared[0x209116][0])), 0x200037)
    spacing = numbers_of(next(dicom_items(shared[0x289110][0])), 0x280030)
    labels = {}
    for frame, group in enumerate(dicom_items(elements[0x52009230][0])):
        position = numbers_of(next(dicom_items(group[0x209113][0])), 0x200032)
        segment = struct.unpack("<H", next(dicom_items(group[0x62000A][0]))[0x62000B][0])[0]
        for n in range(rows * columns):
            place = frame * rows * columns + n
            if bits[place // 8] >> place % 8 & 1:
                labels.setdefault((tuple(position), n), set()).add(segment)
    steps = [[b - a for a, b in zip(points[0], point)] for point in points[1:]]
    bad = size[:2] != [columns, rows] and f"size {size}" or compare(steps[0] + steps[1], [n * spacing[1] for n in turn[:3]] +
                                                                    [n * spacing[0] for n in turn[3:]], "step", 100.0)
    count = 0
    for z in range(size[2]):
        place = [o + z * s for o, s in zip(points[0], steps[2])]
        for n in range(rows * columns):
            here = set().union(*(found for (position, m), found in labels.items() if m == n and math.dist(position, place) < 0.011))
            value = values[z * rows * columns + n]
            count += len(here)
            if value == 0 and here and layers == 0 or value != 0 and value not in here or len(here) > 1 + layers:
                return bad or f"label {value} at {place}, pixel {n}, where the bytes say {here}"
    return bad or ("" if count == sum(map(len, labels.values())) else "some frames are nowhere")


def turned(triangle):
    """Its coordinates, from the smallest corner on."""
    corners = [tuple(single(c) for c in corner[:3]) for corner in triangle]
    first = corners.index(min(corners))
    return sum(corners[first:] + corners[:first], ())


def check_triangles(answer, triangles):
    numbers = [float(word) for word in answer.split()[1:]]
    read = sorted(turned([numbers[k:k + 3] for k in (n, n + 3, n + 6)]) for n in range(0, len(numbers), 9))
    expected = sorted(map(turned, triangles))
    return (compare([len(read)], [len(expected)], "number of triangles") or
            compare([n for t in read for n in t], [n for t in expected for n in t], "coordinate", 1.0))


def check_stl(data, answer):
    count = struct.unpack_from("<I", data, 80)[0] if len(data) >= 84 else -1
    if len(data) == 84 + 50 * count or not data[:5].lower() == b"solid":
        assert len(data) >= 84 + 50 * count
        corners = [struct.unpack_from("<9f", data, 96 + 50 * n) for n in range(count)]
        return check_triangles(answer, [[c[0:3], c[3:6], c[6:9]] for c in corners])
    lines = data.decode("latin-1").lower().splitlines()
    words = " ".join(line for line in lines if line.split()[:1] not in (["solid"], ["endsolid"])).split()
    places = [[float(word) for word in words[n + 1:n + 4]] for n, word in enumerate(words) if word == "vertex"]
    return check_triangles(answer, [places[n:n + 3] for n in range(0, len(places), 3)])


PLY_TYPES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f", "double": "d", "int8": "b",
             "uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I", "float32": "f", "float64": "d"}


def check_ply(data, answer):
    end = re.search(rb"(^|\n)end_header[ \r]*\n", data).end()
    form, parts = "", []
    for line in data[:end].decode("latin-1").split("\n"):
        words = line.split()
        if words[:1] == ["format"]:
            form = words[1]
        elif words[:1] == ["element"]:
            parts.append((words[1], int(words[2]), []))
        elif words[:1] == ["property"]:
            parts[-1][2].append(words[1:])
    texts, order = iter(data[end:].split()), ">" if "big" in form else "<"

    def take(kind):
        nonlocal end
        fmt = PLY_TYPES[kind]
        if form == "ascii":
            word = next(texts)
            return float(word) if fmt in "fd" or not re.fullmatch(rb"[-+]?\d+", word) else int(word)
        end += struct.calcsize(fmt)
        return struct.unpack_from(order + fmt, data, end - struct.calcsize(fmt))[0]
    points, faces = [], []
    for name, count, properties in parts:
        for _ in range(count):
            row = {}
            for words in properties:
                if words[0] == "list":
                    row[words[3]] = [take(words[2]) for _ in range(int(take(words[1])))]
                else:
                    row[words[1] if len(words) > 1 else ""] = take(words[0])
            if name == "vertex":
                points.append([row["x"], row["y"], row["z"]])
            elif name == "face":
                faces.append([int(n) for n in row.get("vertex_indices", row.get("vertex_index"))])
    signs = (-1, -1, 1) if re.search(rb"comment .*SPACE=RAS", data) else (1, 1, 1)
    points = [[s * c for s, c in zip(signs, point)] for point in points]
    assert all(0 <= n < len(points) for face in faces for n in face)
    return check_triangles(answer, [[points[f[0]], points[f[n]], points[f[n + 1]]] for f in faces for n in range(1, len(f) - 1)])


def check_obj(data, answer):
    points, triangles = [], []
    for line in data.decode("latin-1").replace("\\\r\n", " ").replace("\\\n", " ").split("\n"):
        words = line.split("#")[0].split()
        if words[:1] == ["v"]:
            points.append([float(n) for n in words[1:4]])
        elif words[:1] == ["f"]:
            ids = [int(word.split("/")[0]) for word in words[1:]]
            assert 0 not in ids
            corners = [points[n - 1 if n > 0 else n] for n in ids]
            triangles += [[corners[0], corners[n], corners[n + 1]] for n in range(1, len(corners) - 1)]
    signs = (-1, -1, 1) if b"SPACE=RAS" in data else (1, 1, 1)
    return check_triangles(answer, [[[s * c for s, c in zip(signs, p)] for p in t] for t in triangles])


def check_glb(data, answer):
    length = struct.unpack_from("<I", data, 12)[0]
    scene = json.loads(data[20:20 + length])
    binary = data[28 + length:28 + length + struct.unpack_from("<I", data, 20 + length)[0]]

    def accessor(number):
        found = scene["accessors"][number]
        view = scene["bufferViews"][found["bufferView"]]
        fmt = {5126: "f", 5125: "I", 5123: "H", 5121: "B"}[found["componentType"]]
        width = {"VEC3": 3, "SCALAR": 1}[found["type"]]
        at, step = view.get("byteOffset", 0) + found.get("byteOffset", 0), view.get("byteStride") or width * struct.calcsize(fmt)
        assert found["count"] == 0 or min(at, step) >= 0
        return [struct.unpack_from(f"<{width}{fmt}", binary, at + step * n) for n in range(found["count"])]

    def product(a, b):  # of matrices by columns
        return [sum(a[row + 4 * k] * b[k + 4 * column] for k in range(4)) for column in range(4) for row in range(4)]

    def matrix_of(node):
        if "matrix" in node:
            return node["matrix"]
        assert not {"rotation", "scale", "translation"} & set(node)
        return [float(n % 5 == 0) for n in range(16)]
    triangles = []

    def visit(number, above):
        node = scene["nodes"][number]
        matrix = product(above, matrix_of(node))
        for primitive in scene["meshes"][node["mesh"]]["primitives"] if "mesh" in node else []:
            points = [[sum(matrix[row + 4 * k] * n for k, n in enumerate([*point, 1.0])) for row in range(3)]
                      for point in accessor(primitive["attributes"]["POSITION"])]
            ids = [n[0] for n in accessor(primitive["indices"])] if "indices" in primitive else list(range(len(points)))
            x, y, z = (matrix[0:3], matrix[4:7], matrix[8:11])
            if x[0] * (y[1] * z[2] - y[2] * z[1]) - y[0] * (x[1] * z[2] - x[2] * z[1]) + z[0] * (x[1] * y[2] - x[2] * y[1]) < 0:
                ids = [ids[k + n] for k in range(0, len(ids) - 2, 3) for n in (0, 2, 1)]  # as glTF says of reflections
            points = [[1000 * x, -1000 * z, 1000 * y] for x, y, z in points]  # in glTF x is to the left, y up, z to the front
            if primitive.get("mode", 4) == 4:
                triangles.extend([points[n] for n in ids[k:k + 3]] for k in range(0, len(ids) - 2, 3))
        for child in node.get("children", []):
            visit(child, matrix)
    children = {child for node in scene["nodes"] for child in node.get("children", [])}
    roots = scene["scenes"][scene.get("scene", 0)]["nodes"] if "scenes" in scene else set(range(len(scene["nodes"]))) - children
    for root in roots:
        visit(root, [float(n % 5 == 0) for n in range(16)])
    return check_triangles(answer, triangles)


def check_vtp(data, answer):
    triangles = []
    for piece in xml.etree.ElementTree.fromstring(data.decode("latin-1")).iter("Piece"):
        numbers = [float(n) for n in piece.find("Points/DataArray").text.split()][:3 * int(piece.get("NumberOfPoints"))]
        points = [numbers[n:n + 3] for n in range(0, len(numbers), 3)]
        arrays = {array.get("Name"): [int(n) for n in array.text.split()] for array in piece.find("Polys")}
        begin = 0
        for end in arrays["offsets"][:int(piece.get("NumberOfPolys"))]:
            face, begin = [points[n] for n in arrays["connectivity"][begin:end]], end
            assert min(arrays["connectivity"], default=0) >= 0
            triangles += [[face[0], face[n], face[n + 1]] for n in range(1, len(face) - 1)]
    return check_triangles(answer, triangles)


def check_words(answer, expected):
    words = answer.split()[1:]
    if len(words) != len(expected):
        return f"{len(words)} words, where the bytes say {len(expected)}"
    for word, other in zip(words, expected):
        is_same = word == "x" + other.encode("utf-8", "surrogateescape").hex() if isinstance(other, str) else is_near(float(word), other)
        if not is_same:
            return f"{bytes.fromhex(word[1:]) if word[0] == 'x' else word}, where the bytes say {other}"
    return ""


def check_preset(data, answer):
    found = yaml.load(data.decode(), Loader=yaml.BaseLoader)
    expected = []
    for surface in found["surfaces"]:
        text = surface.get("isovalue", "otsu")
        expected += [surface["name"], -12345.0 if "otsu" in text else float(text.lstrip("<>")), float(surface.get("opacity", 1.0))]
    return check_words(answer, expected)


def normal(folder, word):
    """The path as std::filesystem::path::lexically_normal() has it: what ends as a folder does ends with a slash."""
    return os.path.normpath(os.path.join(folder, word)) + "/" * (word.split("/")[-1] in ("", ".", ".."))


def check_cases(path, data, answer):
    head, *lines = [line.rstrip("\r").split("\t") for line in data.decode("utf-8", "surrogateescape").split("\n")]
    expected, folder = [], os.path.realpath(os.path.dirname(path))
    for line in lines:
        if any(word.strip() for word in line):
            row = dict(zip(head, line))
            assert len(line) == len(head)
            expected += [row["case"], *(normal(folder, row[k]) if row.get(k) else "" for k in ("scan", "labels"))]
    return check_words(answer, expected)


def check_labels(data, answer):
    text = re.sub("[\udc80-\udcff]", "?", data.decode("utf-8", "surrogateescape"))
    lines = [line for line in re.split("\r\n|\r|\n", text) if line.strip()]
    heads = [word.strip().lower() for word in lines[0].split("\t")]
    value = next((heads.index(word) for word in ("index", "labelvalue", "label", "value") if word in heads), None)
    found = {}
    for line in lines[1:] if value is not None else lines:
        if line.startswith("#"):
            continue
        words = line.split("\t") if value is not None else line.split(None, 1)
        at = value or 0
        name = words[heads.index("name")] if value is not None and heads.index("name") < len(words) else "" if value is not None else words[1]
        name = "".join(letter for letter in name if not unicodedata.category(letter) == "Cc" or letter in " \t\n\r\v\f")
        found[int(words[at])] = " ".join(name.split()) or f"label {int(words[at])}"
    return check_words(answer, [word for key in sorted(found) for word in (float(key), found[key])])


def check(path, answer):
    """Where the answer is not what the bytes say; empty when it is. Raises when they say nothing that could have been read."""
    if os.path.isdir(path):
        return check_series(path, answer)
    with open(path, "rb") as file:
        data = file.read()
    if path.endswith(".gz"):
        data = unpacked(data)
    name = os.path.basename(path)
    if name == "cases.tsv":
        return check_cases(path, data, answer)
    checks = {"v.nii": check_nifti, "v.nii.gz": check_nifti, "v.nrrd": check_nrrd, "v.mha": check_metaimage, "seg.dcm": check_segmentation,
              "m.stl": check_stl, "m.ply": check_ply, "m.obj": check_obj, "m.glb": check_glb, "m.vtp": check_vtp, "p.yaml": check_preset,
              "labels.tsv": check_labels}
    return checks[name](data, answer)
