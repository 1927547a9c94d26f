# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Random small volumes, held as lists so that the campaign knows what it asks for.

Labels are in reading order, x fastest.  Everything is drawn from the random.Random that is given.
"""
import gzip
import math
import struct
from dataclasses import dataclass, field

TYPES = {  # struct code, numpy, NRRD, NIfTI
    "u8": ("B", "|u1", "uint8", 2),
    "u16": ("H", "<u2", "uint16", 512),
    "u32": ("I", "<u4", "uint32", 768),
    "u64": ("Q", "<u8", "uint64", 1280),
    "i8": ("b", "|i1", "int8", 256),
    "i16": ("h", "<i2", "int16", 4),
    "i32": ("i", "<i4", "int32", 8),
    "i64": ("q", "<i8", "int64", 1024),
}


@dataclass
class Volume:
    """voxels of `dtype`; the space is spacing and origin unless `turned` has directions as rows."""

    kind: str
    shape: tuple
    labels: list
    dtype: str = "u8"
    spacing: tuple = (1.0, 1.0, 1.0)
    origin: tuple = (0.0, 0.0, 0.0)
    turned: list = None
    file: str = "v.npy"  # or a list of files, or a folder of masks
    arguments: list = field(default_factory=list)  # how the program is told of the file
    meaning: list = field(default_factory=list)  # those of them that say what labels are made from
    is_plain: bool = True  # the file ends with the labels, which are not made from anything else
    has_scores: bool = False  # the file has probabilities or distances, which tell the labels

    def values(self):
        return sorted(set(self.labels))

    def with_labels(self, labels, shape=None):
        return Volume(self.kind, shape or self.shape, labels, self.dtype, self.spacing, self.origin)


def draw_shape(random):
    way = random.random()
    if way < 0.70:
        return tuple(random.randint(2, 13) for _ in range(3))
    if way < 0.82:
        return tuple(random.randint(9, 22) for _ in range(3))
    if way < 0.85:
        return tuple(random.randint(24, 44) for _ in range(3))
    if way < 0.94:  # flat or thin
        shape = [random.randint(1, 2) if random.random() < 0.5 else random.randint(3, 40)
                 for _ in range(3)]
        return tuple(shape)
    shape = [random.randint(1, 9), random.randint(1, 9), random.randint(30, 70)]
    random.shuffle(shape)
    return tuple(shape)


def places(shape):
    for z in range(shape[2]):
        for y in range(shape[1]):
            for x in range(shape[0]):
                yield x, y, z


def noise(random, shape):
    weights = [random.random() ** 3 + 0.01 for _ in range(random.randint(2, 5))]
    return random.choices(range(len(weights)), weights, k=math.prod(shape))


def dust(random, shape):
    share = random.choice([0.002, 0.02, 0.1])
    return [random.randint(1, 3) if random.random() < share else 0 for _ in places(shape)]


def boxes(random, shape):
    labels = [0] * math.prod(shape)
    for label in range(1, random.randint(2, 12)):
        ends = [sorted(random.choices(range(n + 1), k=2)) for n in shape]
        for z in range(*ends[2]):
            for y in range(*ends[1]):
                row = (z * shape[1] + y) * shape[0]
                labels[row + ends[0][0] : row + ends[0][1]] = [label] * (ends[0][1] - ends[0][0])
    return labels


def walks(random, shape):
    """Threads of one voxel's width that touch each other in all ways."""
    labels = [0] * math.prod(shape)
    for label in range(1, random.randint(2, 6)):
        at = [random.randrange(n) for n in shape]
        for _ in range(random.randint(5, 120)):
            labels[(at[2] * shape[1] + at[1]) * shape[0] + at[0]] = label
            axis = random.randrange(3)
            at[axis] = min(max(at[axis] + random.choice((-1, 1)), 0), shape[axis] - 1)
    return labels


def balls(random, shape):
    centres = [
        ([random.uniform(0, n) for n in shape], random.uniform(1, 0.5 * max(shape)))
        for _ in range(random.randint(1, 6))
    ]
    labels = []
    for place in places(shape):
        label = 0
        for number, (centre, radius) in enumerate(centres, 1):
            if math.dist(place, centre) < radius:
                label = number
        labels.append(label)
    return labels


def one_label(_, shape):
    return [0] * math.prod(shape)


OWN_KINDS = {"own-noise": noise, "dust": dust, "boxes": boxes, "walks": walks, "balls": balls,
             "one": one_label}
DENSE_KINDS = ("own-noise", "noise", "checkerboard")
MOST_DENSE_VOXELS = 4000  # all of them lie on interfaces: a hundred times the work of others
SYNTH_KINDS = ("voronoi", "tubes", "spheres", "noise", "checkerboard")


def read_npy(path):
    """Shape (x, y, z), labels and type of what `mwmesh synth` wrote."""
    with open(path, "rb") as file:
        data = file.read()
    begin = 10 + struct.unpack("<H", data[8:10])[0]
    header = eval(data[10:begin], {"__builtins__": {}})  # a literal, written by ourselves
    dtype = next(name for name, of in TYPES.items() if of[1].lstrip("|") in header["descr"])
    shape = tuple(reversed(header["shape"]))
    return shape, list(struct.unpack(f"<{math.prod(shape)}{TYPES[dtype][0]}", data[begin:])), dtype


def renamed(random, labels):
    """Other values and a type that holds them: the extremes of the type among them."""
    dtype = random.choice(sorted(TYPES))
    bits = int(dtype[1:])
    least, most = (0, 2**bits - 1) if dtype[0] == "u" else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)
    values = sorted(set(labels))
    if most - least < len(values):
        return labels, "u32"
    new = list(range(len(values)))
    if random.random() < 0.4:
        drawn = {random.choice((least, most))}
        while len(drawn) < len(values):
            drawn.add(random.randint(least, most))
        new = sorted(drawn)
        random.shuffle(new)
    table = dict(zip(values, new))
    return [table[label] for label in labels], dtype


def changed(random, volume):
    """The same with other values of its type: of one voxel, of all labels, or in other order."""
    bits, signed = int(volume.dtype[1:]), volume.dtype[0] == "i"
    least = -(2 ** (bits - 1)) if signed else 0
    values, labels = volume.values(), list(volume.labels)
    way = random.choice(["one", "others", "permuted"])
    if way == "one":
        labels[random.randrange(len(labels))] = least + random.randrange(2**bits)
        return volume.with_labels(labels)
    drawn = random.sample(values, len(values)) if way == "permuted" else [
        least + random.randrange(2**bits) for _ in values]
    table = dict(zip(values, drawn))
    return volume.with_labels([table[label] for label in labels])


def edited(random, volume):
    """A box of the volume gets one of its labels, or another one.  Returns volume, lo, hi."""
    bits, signed = int(volume.dtype[1:]), volume.dtype[0] == "i"
    least = -(2 ** (bits - 1)) if signed else 0
    lo = [random.randrange(n) for n in volume.shape]
    hi = [random.randint(l + 1, min(n, l + 5)) for l, n in zip(lo, volume.shape)]
    new = random.choice(volume.labels) if random.random() < 0.6 else least + random.randrange(2**bits)
    labels, (nx, ny, _) = list(volume.labels), volume.shape
    for z in range(lo[2], hi[2]):
        for y in range(lo[1], hi[1]):
            for x in range(lo[0], hi[0]):
                labels[(z * ny + y) * nx + x] = new
    return volume.with_labels(labels), lo, hi


def draw_spacing(random):
    way = random.random()
    if way < 0.45:
        return (1.0, 1.0, 1.0)
    if way < 0.6:
        h = random.choice([0.5, 0.1, 4e-9, 1e-3, 250.0])
        return (h, h, h)
    if way < 0.8:
        thick = random.choice([(4, 4, 40), (1, 1, 3), (2, 1, 1), (1, 3, 1), (0.6, 0.6, 3.3)])
        return tuple(float(v) for v in thick)
    return tuple(round(math.exp(random.uniform(-1, 1)), random.choice((1, 3, 9))) + 0.01
                 for _ in range(3))


def draw_origin(random, spacing):
    way = random.random()
    if way < 0.5:
        return (0.0, 0.0, 0.0)
    far = random.choice([1, 100, 1e5])
    return tuple(random.uniform(-far, far) * min(spacing) for _ in range(3))


def draw_turn(random):
    """Rows of a rotation, at times with axes swapped or turned over as well."""
    a, b, c, d = (random.gauss(0, 1) for _ in range(4))
    n = math.sqrt(a * a + b * b + c * c + d * d)
    if random.random() < 0.4 or n < 0.1:
        a, b, c, d, n = 1, 0, 0, 0, 1
    a, b, c, d = a / n, b / n, c / n, d / n
    rows = [
        [a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)],
        [2 * (b * c - a * d), a * a - b * b + c * c - d * d, 2 * (c * d + a * b)],
        [2 * (b * d + a * c), 2 * (c * d - a * b), a * a - b * b - c * c + d * d],
    ]
    random.shuffle(rows)
    return [[v * sign for v in row] for row in rows for sign in [random.choice((-1.0, 1.0))]]


def triple(values):
    return ",".join(repr(float(v)) for v in values)


def packed(volume):
    return struct.pack(f"<{len(volume.labels)}{TYPES[volume.dtype][0]}", *volume.labels)


def write_array(path, dtype, shape, data):
    text = f"{{'descr': '{dtype}', 'fortran_order': False, 'shape': {shape}, }}"
    text += " " * (63 - (10 + len(text)) % 64) + "\n"
    with open(path, "wb") as file:
        file.write(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(text)) + text.encode())
        file.write(data)


def write_npy(path, volume):
    write_array(path, TYPES[volume.dtype][1], tuple(reversed(volume.shape)), packed(volume))


def nrrd_header(volume, dtype, squeezed, layers=1, keys=()):
    """The numbers of all layers of a voxel follow each other."""
    rows = [[v * h for v in row] for row, h in zip(volume.turned, volume.spacing)]
    own = layers > 1
    lines = [
        "NRRD0004", f"type: {dtype}", f"dimension: {3 + own}",
        "space: left-posterior-superior",
        "sizes: " + f"{layers} " * own + "{} {} {}".format(*volume.shape),
        "space directions: " + "none " * own + " ".join(f"({triple(row)})" for row in rows),
        "kinds: " + "list " * own + "domain domain domain", "endian: little",
        "encoding: " + ("gzip" if squeezed else "raw"), f"space origin: ({triple(volume.origin)})",
        *keys,
    ]
    return ("\n".join(lines) + "\n\n").encode()


def write_nrrd(path, volume, squeezed):
    data = packed(volume)
    header = nrrd_header(volume, TYPES[volume.dtype][2], squeezed)
    path.write_bytes(header + (gzip.compress(data, 1) if squeezed else data))


def nifti_header(volume, code, bits, volumes=1):
    header = bytearray(352)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 4 if volumes > 1 else 3, *volume.shape, volumes, 1, 1, 1)
    struct.pack_into("<hh", header, 70, code, bits)
    struct.pack_into("<8f", header, 76, 1, *volume.spacing, 0, 0, 0, 0)
    struct.pack_into("<f", header, 108, 352)
    struct.pack_into("<hh", header, 252, 0, 1)
    for axis in range(3):
        row = [volume.turned[i][axis] * volume.spacing[i] for i in range(3)]
        struct.pack_into("<4f", header, 280 + 16 * axis, *row, volume.origin[axis])
    header[344:348] = b"n+1\0"
    return bytes(header)


def write_nifti(path, volume, squeezed):
    data = nifti_header(volume, TYPES[volume.dtype][3], int(volume.dtype[1:])) + packed(volume)
    path.write_bytes(gzip.compress(data, 1) if squeezed else data)


def has_classes(volume):
    """Whether labels are those that masks and classes get: 0, 1, 2 and so on."""
    values = volume.values()
    return values == list(range(len(values))) and 2 <= len(values) <= 9


# Masks --------------------------------------------------------------------------------------------


def draw_sets(random, labels):
    """The masks that each voxel is in: that of its label, and at times those of other voxels."""
    shifts = [random.choice([0, 1, random.randrange(len(labels))]) for _ in range(2)]
    return [tuple(sorted({label, *(labels[i - shift] for shift in shifts)} - {0}))
            for i, label in enumerate(labels)]


def labels_of_sets(sets, masks, rule):
    """What `--overlap` promises."""
    several = sorted({own for own in sets if len(own) > 1})
    number = {own: masks + 1 + i for i, own in enumerate(several)}
    if rule == "all":
        return [number.get(own) or own[0] if own else 0 for own in sets]
    return [own[-1 if rule == "last" else 0] if own else 0 for own in sets]


def write_mask_files(random, folder, volume, masks):
    """A list of files, or a folder of them."""
    is_folder = len(masks) == 1 or random.random() < 0.5
    if is_folder:
        (folder / "masks").mkdir()
    files = []
    for number, mask in enumerate(masks, 1):
        files.append(f"m{number}.nii")
        header = nifti_header(volume, 2, 8)
        (folder / ("masks" if is_folder else "") / files[-1]).write_bytes(header + bytes(mask))
    volume.file = "masks" if is_folder else ",".join(files)


def write_mask_stack(_, folder, volume, masks):
    volume.file = "v.nii"
    data = nifti_header(volume, 2, 8, len(masks)) + b"".join(map(bytes, masks))
    (folder / volume.file).write_bytes(data)


def write_segments(random, folder, volume, masks):
    """As 3D Slicer writes segments that overlap."""
    volume.file, squeezed = "v.seg.nrrd", random.random() < 0.5
    values, keys = [random.randint(1, 255) for _ in masks], []
    for i, value in enumerate(values):
        keys += [f"Segment{i}_ID:=s{i}", f"Segment{i}_Name:=m{i + 1}",
                 f"Segment{i}_LabelValue:={value}", f"Segment{i}_Layer:={i}"]
    data = bytes(bit * value for voxel in zip(*masks) for bit, value in zip(voxel, values))
    header = nrrd_header(volume, "uint8", squeezed, len(masks), keys)
    (folder / volume.file).write_bytes(header + (gzip.compress(data, 1) if squeezed else data))


def element(group, number, kind, value):
    """An attribute of a DICOM file; lists are sequences of items, which are lists of attributes."""
    if kind == "SQ":
        items = [b"".join(item) for item in value]
        value = b"".join(struct.pack("<HHI", 0xFFFE, 0xE000, len(i)) + i for i in items)
    elif kind == "US":
        value = struct.pack("<H", value)
    elif isinstance(value, str):
        value = value.encode() + (b"\0" if kind == "UI" else b" ") * (len(value) % 2)
    value += b"\0" * (len(value) % 2)
    length = ("<HI", 0, len(value)) if kind in ("OB", "SQ") else ("<H", len(value))
    return struct.pack("<HH", group, number) + kind.encode() + struct.pack(*length) + value


def decimals(*values):
    return "\\".join(f"{v:.9g}" for v in values)


def write_dicom(_, folder, volume, masks):
    """A frame for each slice of each segment, along the axes."""
    volume.file, kind = "v.dcm", "1.2.840.10008.5.1.4.1.1.66.4"
    (nx, ny, nz), (hx, hy, hz) = volume.shape, volume.spacing
    bits = [bit for mask in masks for bit in mask]
    bits += [0] * (-len(bits) % 8)
    pixels = bytes(sum(bit << k for k, bit in enumerate(bits[i:i + 8]))
                   for i in range(0, len(bits), 8))
    segments = [[element(0x62, 4, "US", m), element(0x62, 5, "LO", f"m{m}")]
                for m in range(1, len(masks) + 1)]
    shared = [
        element(0x20, 0x9116, "SQ", [[element(0x20, 0x37, "DS", decimals(1, 0, 0, 0, 1, 0))]]),
        element(0x28, 0x9110, "SQ", [[element(0x18, 0x50, "DS", decimals(hz)),
                                      element(0x18, 0x88, "DS", decimals(hz)),
                                      element(0x28, 0x30, "DS", decimals(hy, hx))]]),
    ]
    frames = [[element(0x20, 0x9113, "SQ", [[element(0x20, 0x32, "DS", decimals(0, 0, z * hz))]]),
               element(0x62, 0xA, "SQ", [[element(0x62, 0xB, "US", m)]])]
              for m in range(1, len(masks) + 1) for z in range(nz)]
    meta = b"".join([element(2, 1, "OB", b"\0\1"), element(2, 2, "UI", kind),
                     element(2, 0x10, "UI", "1.2.840.10008.1.2.1")])
    data = [element(2, 0, "UL", struct.pack("<I", len(meta))), meta, element(8, 0x16, "UI", kind),
            element(0x28, 8, "IS", str(len(frames))), element(0x28, 0x10, "US", ny),
            element(0x28, 0x11, "US", nx), element(0x28, 0x100, "US", 1),
            element(0x62, 1, "CS", "BINARY"), element(0x62, 2, "SQ", segments),
            element(0x5200, 0x9229, "SQ", [shared]), element(0x5200, 0x9230, "SQ", frames),
            element(0x7FE0, 0x10, "OB", pixels)]
    (folder / volume.file).write_bytes(bytes(128) + b"DICM" + b"".join(data))


def write_masks(random, folder, volume):
    """Masks that overlap or not; what they become are labels of 16 bits."""
    count = max(volume.labels)
    sets = draw_sets(random, volume.labels)
    masks = [[int(m in own) for own in sets] for m in range(1, count + 1)]
    ways = [write_mask_files]
    if count > 1:
        ways += [write_mask_stack, write_segments]
    if min(volume.spacing) > 0.05:  # DICOM takes slices a thousandth of a mm apart for one
        ways.append(write_dicom)
    way, rule = random.choice(ways), random.choice(["first", "last", "all"])
    is_dicom = way == write_dicom
    volume.turned = [[1, 0, 0], [0, 1, 0], [0, 0, 1]] if is_dicom else draw_turn(random)
    way(random, folder, volume, masks)
    if any(len(own) > 1 for own in sets) or random.random() < 0.5:
        volume.meaning = ["--overlap", rule]
    volume.labels, volume.dtype = labels_of_sets(sets, count, rule), "u16"
    volume.is_plain = False
    volume.arguments = ["--spacing", triple(volume.spacing), "--frame=voxel"] if is_dicom else [
        "--frame", random.choice(["file", "file", "ras", "lps", "voxel"])]
    volume.arguments += volume.meaning


# Scores -------------------------------------------------------------------------------------------


def scores_of(random, label, classes, kind):
    """Numbers, one for each class, from which the voxel has this label."""
    if kind == "softmax":
        powers = [math.exp(random.uniform(1, 4) if c == label else random.uniform(-4, 0.9))
                  for c in range(classes)]
        return [power / sum(powers) for power in powers]
    if kind == "sigmoid":
        return [random.uniform(0.501, 1) if label == 1 else random.uniform(0, 0.499)]
    if kind == "probabilities":
        return [random.uniform(0.5, 1) if c == label else random.uniform(0, 0.499)
                for c in range(classes)]
    return [-random.uniform(0.001, 2) if c == label else random.uniform(0.001, 2)
            for c in range(1, classes)]


def write_scores(random, folder, volume):
    """Random ones, which put interfaces anywhere within half a voxel of the faces."""
    classes = len(volume.values())
    kind = random.choice(["softmax", "probabilities", "distances"] + ["sigmoid"] * (classes == 2))
    scores = [scores_of(random, label, classes, kind) for label in volume.labels]
    components = [struct.pack(f"<{len(c)}f", *c) for c in zip(*scores)]
    volume.dtype, volume.is_plain, volume.has_scores = "u8", False, True
    volume.meaning = ["--values", "distances" if kind == "distances" else "probabilities"]
    shape, way = tuple(reversed(volume.shape)), random.choice(["npy", "files", "nifti", "nrrd"])
    place = ["--spacing", triple(volume.spacing), "--origin=" + triple(volume.origin)]
    if way in ("nifti", "nrrd"):
        volume.turned = draw_turn(random)
        place = ["--frame", random.choice(["file", "ras", "lps", "voxel"])]
    if way == "npy":
        write_array(folder / "v.npy", "<f4", (len(components), *shape), b"".join(components))
    elif way == "files":
        files = [f"c{i}.npy" for i in range(len(components))]
        for file, component in zip(files, components):
            write_array(folder / file, "<f4", shape, component)
        volume.file = ",".join(files)
    elif way == "nifti":
        volume.file = "v.nii"
        header = nifti_header(volume, 16, 32, len(components))
        (folder / volume.file).write_bytes(header + b"".join(components))
    else:
        volume.file = "v.nrrd"
        data = b"".join(struct.pack(f"<{len(voxel)}f", *voxel) for voxel in scores)
        header = nrrd_header(volume, "float", False, len(components))
        (folder / volume.file).write_bytes(header + data)
    volume.arguments = [*volume.meaning, *place]


def write(random, volume, folder):
    """Writes the file and sets `file` and `arguments`."""
    place = ["--spacing", triple(volume.spacing), "--origin=" + triple(volume.origin)]
    way = random.random()
    if random.random() < 0.4 and has_classes(volume):
        random.choice([write_scores, write_masks])(random, folder, volume)
    elif way < 0.65:
        write_npy(folder / "v.npy", volume)
        volume.file, volume.arguments = "v.npy", place
    elif way < 0.75:
        (folder / "v.raw").write_bytes(packed(volume))
        shape = ",".join(map(str, volume.shape))
        volume.file = "v.raw"
        volume.arguments = ["--shape", shape, "--dtype", volume.dtype, *place]
    else:
        volume.turned = draw_turn(random)
        squeezed = random.random() < 0.3
        if way < 0.85:
            volume.file = "v.nrrd"
            write_nrrd(folder / volume.file, volume, squeezed)
        else:
            volume.file = "v.nii.gz" if squeezed else "v.nii"
            write_nifti(folder / volume.file, volume, squeezed)
        frame = random.choice(["file", "file", "ras", "lps", "voxel"])
        volume.arguments = ["--frame", frame]


def draw(random, folder, run):
    """A volume and its file in `folder`.  run(arguments): the program."""
    kind = random.choice(SYNTH_KINDS + tuple(OWN_KINDS))
    shape = draw_shape(random)
    while kind in DENSE_KINDS and math.prod(shape) > MOST_DENSE_VOXELS:
        shape = draw_shape(random)
    if kind in SYNTH_KINDS:
        run(["synth", kind, "--shape", ",".join(map(str, shape)), "--labels",
             str(random.randint(1, 20)), "--seed", str(random.randrange(10**6)), "-o", "s.npy"])
        shape, labels, dtype = read_npy(folder / "s.npy")
        (folder / "s.npy").unlink()
    else:
        labels, dtype = OWN_KINDS[kind](random, shape), "u8"
    if random.random() < 0.5:
        labels, dtype = renamed(random, labels)
    spacing = draw_spacing(random)
    volume = Volume(kind, shape, labels, dtype, spacing, draw_origin(random, spacing))
    write(random, volume, folder)
    return volume
