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
    file: str = "v.npy"  # or a list of masks
    arguments: list = field(default_factory=list)  # how the program is told of the file
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


def write_nrrd(path, volume, squeezed):
    rows = [[v * h for v in row] for row, h in zip(volume.turned, volume.spacing)]
    lines = [
        "NRRD0004", f"type: {TYPES[volume.dtype][2]}", "dimension: 3",
        "space: left-posterior-superior", "sizes: {} {} {}".format(*volume.shape),
        "space directions: " + " ".join(f"({triple(row)})" for row in rows),
        "kinds: domain domain domain", "endian: little",
        "encoding: " + ("gzip" if squeezed else "raw"), f"space origin: ({triple(volume.origin)})",
    ]
    data = packed(volume)
    with open(path, "wb") as file:
        file.write(("\n".join(lines) + "\n\n").encode())
        file.write(gzip.compress(data, 1) if squeezed else data)


def write_nifti(path, volume, squeezed):
    header = bytearray(352)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 3, *volume.shape, 1, 1, 1, 1)
    struct.pack_into("<hh", header, 70, TYPES[volume.dtype][3], int(volume.dtype[1:]))
    struct.pack_into("<8f", header, 76, 1, *volume.spacing, 0, 0, 0, 0)
    struct.pack_into("<f", header, 108, 352)
    struct.pack_into("<hh", header, 252, 0, 1)
    for axis in range(3):
        row = [volume.turned[i][axis] * volume.spacing[i] for i in range(3)]
        struct.pack_into("<4f", header, 280 + 16 * axis, *row, volume.origin[axis])
    header[344:348] = b"n+1\0"
    data = bytes(header) + packed(volume)
    with open(path, "wb") as file:
        file.write(gzip.compress(data, 1) if squeezed else data)


def can_be_masks(volume):
    """Whether labels are those that masks get: 1, 2, 3 and so on, 0 elsewhere."""
    values = volume.values()
    return values == list(range(len(values))) and 2 <= len(values) <= 9


def write_masks(folder, volume):
    """A file for each label; what a list of them has are labels of 16 bits."""
    files = []
    for label in volume.values()[1:]:
        mask = Volume(volume.kind, volume.shape, [int(l == label) for l in volume.labels], "u8",
                      volume.spacing, volume.origin, volume.turned)
        files.append(f"m{label}.nii")
        write_nifti(folder / files[-1], mask, False)
    volume.file, volume.dtype = ",".join(files), "u16"


def scores_of(random, label, classes, kind):
    """Numbers, one for each class, from which the voxel has this label."""
    if kind == "probabilities":
        return [random.uniform(0.5, 1) if c == label else random.uniform(0, 0.499)
                for c in range(classes)]
    return [-random.uniform(0.001, 2) if c == label else random.uniform(0.001, 2)
            for c in range(1, classes)]


def write_scores(random, folder, volume):
    """Random ones, which put interfaces anywhere within half a voxel of the faces."""
    kind = random.choice(["probabilities", "distances"])
    classes = len(volume.values())
    scores = [scores_of(random, label, classes, kind) for label in volume.labels]
    components = list(zip(*scores))
    data = b"".join(struct.pack(f"<{len(c)}f", *c) for c in components)
    write_array(folder / "v.npy", "<f4", (len(components), *reversed(volume.shape)), data)
    volume.file, volume.dtype, volume.has_scores = "v.npy", "u8", True
    return ["--values", kind]


def write(random, volume, folder):
    """Writes the file and sets `file` and `arguments`."""
    place = ["--spacing", triple(volume.spacing), "--origin=" + triple(volume.origin)]
    way = random.random()
    if random.random() < 0.15 and can_be_masks(volume):
        volume.arguments = [*write_scores(random, folder, volume), *place]
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
        if way < 0.80 and can_be_masks(volume):
            write_masks(folder, volume)
        elif way < 0.88:
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
