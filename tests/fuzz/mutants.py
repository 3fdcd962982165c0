"""Small files of each format, and how each is damaged: for malformed.py."""

import os
import re
import shutil
import struct
import zlib

NUMBERS = ["0", "-0", "1", "-1", "2", "3", "7", "127", "128", "255", "256", "32767", "32768", "65535", "65536", "2147483647", "2147483648",
           "-2147483648", "4294967295", "4294967296", "9223372036854775807", "18446744073709551616", "nan", "-nan", "inf", "-inf", "1e-300",
           "1e300", "1e-40", "1e40", "0.5", "-2.5", "1e", "0x10", "1,5", "+3", "", " ", "1e9", "1e-9", "007", "1.0", "3.0000001"]
INTEGERS = [0, 1, 2, 3, 4, 5, 7, 8, 15, 16, 17, 63, 64, 127, 128, 255, 256, 32767, 32768, 65534, 65535, 65536, 2**31 - 1, 2**31, 2**32 - 2,
            2**32 - 1, 2**32, 2**63 - 1, 2**63, 2**64 - 1]
REALS = [0.0, -0.0, 1.0, -1.0, 0.5, -2.5, 3.0, 352.0, 353.0, 352.5, 1e-12, 1e-3, 1e3, 1e9, 1e30, -1e30, float("nan"), float("inf"),
         float("-inf"), 1e-40, 0.70710678, 0.1]


def damage_number(fmt, data, offset, random):
    """Another value in place of a number of a binary file."""
    size = struct.calcsize(fmt)
    if fmt[-1] in "fd":
        value = random.choice([*REALS, -struct.unpack_from(fmt, data, offset)[0], 2 * struct.unpack_from(fmt, data, offset)[0]])
        new = struct.pack(fmt, min(max(value, -3e38), 3e38) if fmt[-1] == "f" and abs(value) < float("inf") else value)
    else:
        old = int.from_bytes(data[offset:offset + size], "little" if fmt[0] == "<" else "big")
        value = random.choice([*INTEGERS, old + 1, old - 1, 2 * old, -old]) % (1 << 8 * size)
        new = value.to_bytes(size, "little" if fmt[0] == "<" else "big")
    return data[:offset] + new + data[offset + size:]


def damage_bytes(data, random):
    """Cut off, with more behind, a part twice or left out, a flipped bit, or two parts in another order."""
    place, length = random.randrange(len(data) + 1), random.choice([1, 2, 4, 8, 16, 64, 256])
    way = random.randrange(6)
    if way == 0:
        return data[:place]
    if way == 1:
        return data + bytes(random.randrange(256) for _ in range(length))
    if way == 2:
        return data[:place] + data[place:place + length] + data[place:]
    if way == 3:
        return data[:place] + data[place + length:]
    if way == 4 and place < len(data):
        return data[:place] + bytes([data[place] ^ 1 << random.randrange(8)]) + data[place + 1:]
    return data[:place] + data[place + length:place + 2 * length] + data[place:place + length] + data[place + 2 * length:]


def damage_text(text, random, separators=r"[ \t,:=/()\"\\<>]"):
    """Another number or word, or a line that is left out, twice, cut off or elsewhere."""
    lines = text.split("\n")
    line = random.randrange(len(lines))
    way = random.randrange(9)
    if way == 0:
        del lines[line]
    elif way == 1:
        lines.insert(line, lines[line])
    elif way == 2:
        other = random.randrange(len(lines))
        lines[line], lines[other] = lines[other], lines[line]
    elif way == 3:
        lines[line] = lines[line][:random.randrange(len(lines[line]) + 1)]
    else:
        numbers = list(re.finditer(r"[-+]?\d+(\.\d*)?([eE][-+]?\d+)?" if way < 8 else r"[A-Za-z_]+", text))
        if numbers:
            found, by = random.choice(numbers), random.choice(NUMBERS)
            if way == 8:
                by = random.choice([random.choice(numbers).group(), found.group().upper(), found.group()[:-1], "", "none", "x", "\u00b5m", "true"])
            elif way == 7:
                by = random.choice(numbers).group()
            elif way == 6:
                by = random.choice(["-" + found.group(), found.group() + "0", found.group() + ".5", found.group() + " " + found.group()])
            return text[:found.start()] + by + text[found.end():]
    return "\n".join(lines)


class File:
    """A format whose seeds are files. \"fields\" tells the numbers of a seed: format and offset."""

    slowness = 1

    def __init__(self, name, make, fields=None, header=None):
        self.name, self.make, self.fields, self.header = name, make, fields, header

    def seeds(self, folder):
        return self.make(folder)

    def mutate(self, data, random):
        for _ in range(random.choice([1, 1, 1, 2, 3])):
            end = self.header(data) if self.header else 0
            way = random.randrange(8)
            if way == 0 and data:
                data = damage_bytes(data, random)
            elif end and (way < 6 or not self.fields):
                data = damage_text(data[:end].decode("latin-1"), random).encode("utf-8", "replace") + data[end:]
            elif self.fields and data:
                fields = [(fmt, at) for fmt, at in self.fields(data) if at + struct.calcsize(fmt) <= len(data)]
                data = damage_number(*self.pick(fields, data, random), random) if fields else data
        return data

    def pick(self, fields, data, random):
        fmt, offset = random.choice(fields)
        return fmt, data, offset

    def write(self, data, folder):
        path = os.path.join(folder, self.name)
        with open(path, "wb") as file:
            file.write(data)
        return path


def nifti_fields(data):
    """The fields of nifti1.h that place the voxels and say what they are."""
    order = "<" if data[:4] == b"\x5c\1\0\0" else ">"
    fields = [("i", 0), ("h", 68), ("h", 70), ("h", 72), ("f", 108), ("f", 112), ("f", 116), ("B", 123), ("h", 252), ("h", 254), ("i", 344)]
    fields += [("h", 40 + 2 * n) for n in range(8)] + [("f", 76 + 4 * n) for n in range(8)]
    fields += [("f", 256 + 4 * n) for n in range(6)] + [("f", 280 + 4 * n) for n in range(12)]
    return [(order + fmt, at) for fmt, at in fields]


def nifti(order="<", datatype=4, fmt="h", q=0, s=2, slope=0.0, values=range(24), size=(2, 3, 4)):
    data = bytearray(352)

    def put(kind, at, *numbers):
        struct.pack_into(order + kind, data, at, *numbers)
    put("i", 0, 348)
    put("8h", 40, 3, *size, 1, 1, 1, 1)
    put("hh", 70, datatype, 8 * struct.calcsize(order + fmt))
    put("8f", 76, 1, 1.5, 2, 2.5, 1, 1, 1, 1)
    put("3f", 108, 352, slope, 10 if slope else 0)
    put("B", 123, 2)
    put("hh", 252, q, s)
    put("6f", 256, 0.1, -0.2, 0.3, 4, 5, 6)
    put("12f", 280, -1.5, 0, 0, 7, 0, 2, 0, -8, 0, 0, 2.5, 9)
    data[344:348] = b"n+1\0"
    return bytes(data) + b"".join(struct.pack(order + fmt, value) for value in values)


def nifti_seeds(_):
    return [nifti(), nifti(">", 16, "f", q=1, s=0), nifti(q=1, s=1, slope=2.0, datatype=512, fmt="H"), nifti(datatype=256, fmt="b", q=0, s=0),
            nifti(datatype=64, fmt="d"), nifti(datatype=8, fmt="i")]


class Compressed(File):
    """NIfTI within gzip: damaged before or after it is packed."""

    def seeds(self, folder):
        return [(seed, None) for seed in nifti_seeds(folder)]

    def mutate(self, seed, random):
        data = File.mutate(self, seed[0], random) if random.randrange(2) else seed[0]
        packer = zlib.compressobj(random.choice([0, 1, 9]), zlib.DEFLATED, 31)
        packed = packer.compress(data) + packer.flush()
        return data, damage_bytes(packed, random) if random.randrange(2) else packed

    def write(self, seed, folder):
        packer = zlib.compressobj(6, zlib.DEFLATED, 31)
        return File.write(self, packer.compress(seed[0]) + packer.flush() if seed[1] is None else seed[1], folder)


VOXELS = b"".join(struct.pack("<h", 3 * n - 20) for n in range(24))


def nrrd_seeds(_):
    space = ("NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 2 3 4\n"
             "space directions: (1.5,0,0) (0,2,0) (0,0.5,2.5)\nkinds: domain domain domain\nendian: little\nencoding: raw\n"
             "space origin: (7,-8,9)\n\n")
    gzip = space.replace("raw", "gzip").replace("left-posterior", "right-anterior")
    packer = zlib.compressobj(6, zlib.DEFLATED, 31)
    plain = "NRRD0001\ntype: uchar\ndimension: 3\nsizes: 2 3 8\nspacings: 1 2 3\nencoding: raw\nbyte skip: 0\n\n"
    return [space.encode() + VOXELS, gzip.encode() + packer.compress(VOXELS) + packer.flush(), plain.encode() + VOXELS,
            space.replace("little", "big").replace("short", "float").replace("2 3 4", "2 3 2").encode() + struct.pack(">12f", *range(12))]


def text_end(data, mark):
    place = data.find(mark)
    return place + len(mark) if place >= 0 else len(data)


def meta_seeds(_):
    head = ("ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = False\n"
            "TransformMatrix = 0 1 0 -1 0 0 0 0 1\nOffset = 7 -8 9\nCenterOfRotation = 0 0 0\nElementSpacing = 1.5 2 2.5\n"
            "DimSize = 2 3 4\nElementType = MET_SHORT\nElementDataFile = LOCAL\n")
    return [head.encode() + VOXELS, head.replace("= False\nC", "= True\nC").encode() + VOXELS,
            head.replace("CompressedData = False", "CompressedData = True").encode() + zlib.compress(VOXELS),
            head.replace("MET_SHORT", "MET_UCHAR").replace("3 4", "3 8").encode() + VOXELS]


LONG = (b"OB", b"OW", b"SQ", b"UN")


def element(tag, kind, value):
    value = value if len(value) % 2 == 0 else value + (b"\0" if kind in (b"UI", b"OB") else b" ")
    length = b"\0\0" + struct.pack("<I", len(value)) if kind in LONG else struct.pack("<H", len(value))
    return [struct.pack("<HH", tag >> 16, tag & 0xffff), kind, length, value]


def us(value):
    return struct.pack("<H", value)


def slice_elements(number, bits=16):
    values = struct.pack("<6h", *(100 * number + n for n in range(6)))
    return [element(0x00020010, b"UI", b"1.2.840.10008.1.2.1"), element(0x00080016, b"UI", b"1.2.840.10008.5.1.4.1.1.2"),
            element(0x00080018, b"UI", b"1.2.3.%d" % number), element(0x00080060, b"CS", b"CT"), element(0x0020000D, b"UI", b"1.2.3"),
            element(0x0020000E, b"UI", b"1.2.3.4"), element(0x00200011, b"IS", b"7"), element(0x00200013, b"IS", b"%d" % number),
            element(0x00200032, b"DS", b"5\\-6\\%g" % (2.5 * number)), element(0x00200037, b"DS", b"1\\0\\0\\0\\1\\0"),
            element(0x00280002, b"US", us(1)), element(0x00280004, b"CS", b"MONOCHROME2"), element(0x00280010, b"US", us(2)),
            element(0x00280011, b"US", us(3)), element(0x00280030, b"DS", b"1.5\\2"), element(0x00280100, b"US", us(16)),
            element(0x00280101, b"US", us(bits)), element(0x00280102, b"US", us(bits - 1)), element(0x00280103, b"US", us(1)),
            element(0x00281052, b"DS", b"-1024"), element(0x00281053, b"DS", b"1"), element(0x7FE00010, b"OW", values)]


def item(elements):
    data = b"".join(b"".join(parts) for parts in elements)
    return struct.pack("<HHI", 0xFFFE, 0xE000, len(data)) + data


def seg_elements():
    """A segmentation of two segments on 2 x 8 pixels in three frames."""
    common = [element(0x00209116, b"SQ", item([element(0x00200037, b"DS", b"1\\0\\0\\0\\1\\0")])),
              element(0x00289110, b"SQ", item([element(0x00180050, b"DS", b"2.5"), element(0x00180088, b"DS", b"2.5"),
                                               element(0x00280030, b"DS", b"1.5\\2")]))]
    frames = [(1, 0), (1, 1), (2, 2)]
    frame_items = b"".join(item([element(0x00209111, b"SQ", item([element(0x00209157, b"UL", struct.pack("<II", segment, place + 1))])),
                                 element(0x00209113, b"SQ", item([element(0x00200032, b"DS", b"5\\-6\\%g" % (2.5 * place))])),
                                 element(0x0062000A, b"SQ", item([element(0x0062000B, b"US", us(segment))]))]) for segment, place in frames)
    segments = b"".join(item([element(0x00620004, b"US", us(n)), element(0x00620005, b"LO", b"part %d" % n)]) for n in (1, 2))
    return [element(0x00020010, b"UI", b"1.2.840.10008.1.2.1"), element(0x00080016, b"UI", b"1.2.840.10008.5.1.4.1.1.66.4"),
            element(0x00080018, b"UI", b"1.2.3.9"), element(0x00080060, b"CS", b"SEG"), element(0x0020000D, b"UI", b"1.2.3"),
            element(0x0020000E, b"UI", b"1.2.3.4"), element(0x00280002, b"US", us(1)), element(0x00280004, b"CS", b"MONOCHROME2"),
            element(0x00280008, b"IS", b"3"), element(0x00280010, b"US", us(2)), element(0x00280011, b"US", us(8)),
            element(0x00280100, b"US", us(1)), element(0x00280101, b"US", us(1)), element(0x00280102, b"US", us(0)),
            element(0x00280103, b"US", us(0)), element(0x00620001, b"CS", b"BINARY"), element(0x00620002, b"SQ", segments),
            element(0x52009229, b"SQ", item(common)), element(0x52009230, b"SQ", frame_items),
            element(0x7FE00010, b"OB", b"\x0f\xf0\x3c\x81\xaa\x55")]


def encode(elements):
    return bytes(128) + b"DICM" + b"".join(b"".join(parts) for parts in elements)


def mutate_elements(elements, random):
    elements = [list(parts) for parts in elements]
    for _ in range(random.choice([1, 1, 2])):
        place = random.randrange(len(elements))
        tag, kind, length, value = elements[place]
        way = random.randrange(9)
        if way == 0 and len(elements) > 1:
            del elements[place]
        elif way == 1:
            elements.insert(place, list(elements[place]))
        elif way == 2:
            other = random.randrange(len(elements))
            elements[place], elements[other] = elements[other], elements[place]
        elif way == 3:
            elements[place][1] = random.choice([b"OB", b"OW", b"SQ", b"UN", b"US", b"DS", b"??", b"\0\0"])
        elif way == 4:
            fmt = "<I" if len(length) == 6 else "<H"
            old = struct.unpack(fmt, length[-struct.calcsize(fmt):])[0]
            new = random.choice([*INTEGERS, old + 2, old - 2, old + 1]) % (1 << 8 * struct.calcsize(fmt))
            elements[place][2] = length[:-struct.calcsize(fmt)] + struct.pack(fmt, new)
        elif kind in (b"US", b"OW", b"OB", b"SQ", b"UL") and value:
            if kind == b"SQ":
                at = random.randrange(len(value))
                new = value[:at] + bytes([random.choice([0, 1, 2, 127, 255, value[at] ^ 1, 48 + random.randrange(10)])]) + value[at + 1:]
            else:
                new = damage_number("<H" if len(value) > 1 else "<B", value, 2 * random.randrange(max(1, len(value) // 2)), random)
            elements[place] = element(struct.unpack("<HH", tag)[0] << 16 | struct.unpack("<HH", tag)[1], kind, new)
        elif value:
            new = damage_text(value.decode("latin-1"), random).encode("latin-1", "replace")
            elements[place] = element(struct.unpack("<HH", tag)[0] << 16 | struct.unpack("<HH", tag)[1], kind, new)
    return elements


class Segmentation(File):
    def __init__(self):
        self.name = "seg.dcm"

    def seeds(self, _):
        return [encode(seg_elements())]

    def mutate(self, seed, random):
        data = encode(mutate_elements(seg_elements(), random))
        return damage_bytes(data, random) if random.randrange(8) == 0 else data


class Series:
    """A folder of four slices, of which one or all are damaged in the same way."""

    slowness = 1

    def seeds(self, _):
        return [[encode(slice_elements(n)) for n in range(4)], [encode(slice_elements(n, 12)) for n in range(4)]]

    def mutate(self, seed, random):
        bits, state, at = 16 if random.randrange(3) else 12, random.getrandbits(32), random.randrange(4)
        everywhere = random.randrange(2)
        files = []
        for n in range(4):
            elements = slice_elements(n, bits)
            if everywhere or n == at:
                elements = mutate_elements(elements, type(random)(state))
            files.append(encode(elements))
        if random.randrange(10) == 0:
            files[at] = damage_bytes(files[at], random)
        return files

    def write(self, files, folder):
        path = os.path.join(folder, "series")
        shutil.rmtree(path, ignore_errors=True)
        os.mkdir(path)
        for n, data in enumerate(files):
            with open(os.path.join(path, f"{n}.dcm"), "wb") as file:
                file.write(data)
        return path


def surface_seeds(extension):
    def make(folder):
        place = os.path.join(folder, "rhombicSurfaceFileFuzz")
        found = [name for name in sorted(os.listdir(place)) if name.endswith(extension)]
        return [open(os.path.join(place, name), "rb").read()[1:] for name in found]
    return make


def stl_fields(data):
    return [("<I", 80)] + [("<f", at) for at in range(84, len(data) - 3, 50) for at in range(at, at + 48, 4)]


def ply_fields(data):
    end = text_end(data, b"end_header\n")
    return [("<f", at) for at in range(end, min(len(data) - 3, end + 48), 4)] + [("<i", at) for at in range(max(end, len(data) - 52), len(data) - 3)]


def glb_fields(data):
    end = glb_end(data)
    return [("<I", at) for at in (0, 4, 8, 12, 16)] + [("<I", end), ("<I", end + 4)] + [("<f", at) for at in range(end + 8, len(data) - 3, 4)]


def glb_end(data):
    return 20 + struct.unpack_from("<I", data, 12)[0] if len(data) >= 20 else 0


class GLB(File):
    """Lengths follow the damaged text in most mutants, as otherwise all would be refused for them."""

    def __init__(self):
        File.__init__(self, "m.glb", surface_seeds(".glb"), glb_fields)

    def mutate(self, data, random):
        if random.randrange(4) == 0:
            return File.mutate(self, data, random)
        end = glb_end(data)
        text = data[20:end].decode()
        for _ in range(random.choice([1, 1, 2])):
            text = damage_json(text, random)
        text = text.encode("utf-8", "replace")
        text += b" " * (-len(text) % 4)
        new = data[:12] + struct.pack("<I", len(text)) + data[16:20] + text + data[end:]
        return new[:8] + struct.pack("<I", len(new)) + new[12:]


def damage_json(text, random):
    numbers = list(re.finditer(r"-?\d+(\.\d+)?(e-?\d+)?", text))
    if not numbers:
        return damage_text(text, random)
    found = random.choice(numbers)
    by = random.choice([*NUMBERS[:12], "5", "4", "-0.5", "5121", "5123", "5125", "5126", random.choice(numbers).group(), found.group() + "0"])
    return damage_text(text, random) if random.randrange(5) == 0 else text[:found.start()] + by + text[found.end():]


def vtp_seeds(_):
    return [b"""<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian">
<PolyData>
<Piece NumberOfPoints="4" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="4">
<Points>
<DataArray type="Float32" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 0 1 0 0 0 1
</DataArray>
</Points>
<Polys>
<DataArray type="Int32" Name="connectivity" format="ascii">
0 2 1 0 1 3 1 2 3 2 0 3
</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">
3 6 9 12
</DataArray>
</Polys>
</Piece>
</PolyData>
</VTKFile>
"""]


def yaml_seeds(_):
    return [b"name: x\ndescription: d\nsurfaces:\n  - {name: a, isovalue: -500.5, opacity: 0.25}\n  - {name: b, isovalue: 7}\n",
            b"name: x\ndescription: d\nsurfaces:\n- name: a\n  isovalue: 1e3\n  opacity: 1\n- name: b\n  isovalue: .5\n"]


def cases_seeds(_):
    return [b"case\tscan\tlabels\toptions\na\ta.nii\tb.nii\t--series 3\nb\tc.nii\t\t\nc-1\td 1.nii\te.nii\t\n",
            b"scan\tcase\ts.nii\tx\nt.nii\ty\n".replace(b"\ts.nii", b"\n" b"s.nii")]


def labels_seeds(_):
    return [b"index\tname\tcolor\n1\tGrey Matter\t#ff53bb\n2\tb\tn/a\n7\tc\t#000000\n"]


class Slow(File):
    slowness = 10  # VTK reads these in a child process for each


KINDS = {
    "dicom": Series(), "seg": Segmentation(), "nifti": File("v.nii", nifti_seeds, nifti_fields), "gzip": Compressed("v.nii.gz", None, nifti_fields),
    "nrrd": File("v.nrrd", nrrd_seeds, header=lambda data: text_end(data, b"\n\n")),
    "metaimage": File("v.mha", meta_seeds, header=lambda data: text_end(data, b"LOCAL\n")),
    "stl": File("m.stl", surface_seeds(".stl"), stl_fields, lambda data: len(data) if data[:6] == b"solid " else 0),
    "ply": File("m.ply", surface_seeds(".ply"), ply_fields, lambda data: text_end(data, b"end_header\n") if b"binary" in data[:80] else len(data)),
    "obj": File("m.obj", surface_seeds(".obj"), header=len), "glb": GLB(), "vtp": Slow("m.vtp", vtp_seeds, header=len),
    "preset": File("p.yaml", yaml_seeds, header=len), "manifest": File("cases.tsv", cases_seeds, header=len),
    "labels": File("labels.tsv", labels_seeds, header=len),
}
