# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Random settings of a run, and what the program promises under them (README, P1 to P8)."""
from dataclasses import dataclass, field

FORMATS = ("vtkhdf", "vtu", "mesh", "msh")  # those that are read as well
KEEP_PROMISES = ("vtkhdf", "vtu", "mesh")  # formats that tell what the run promised


@dataclass
class Settings:
    """flags: name -> value, None for a flag alone.  prepare: those that change the volume."""

    flags: dict = field(default_factory=dict)
    prepare: dict = field(default_factory=dict)
    chosen: dict = field(default_factory=dict)  # --labels or --background
    output: str = "m.vtu"
    merged: dict = field(default_factory=dict)  # old label -> new
    crop: tuple = None
    halvings: int = 0  # how often sizes ask for tets to be cut, at most

    def arguments(self):
        out = []
        for flags in (self.prepare, self.chosen, self.flags):
            for name, value in flags.items():
                out.append(f"--{name}" if value is None else f"--{name}={value}")
        return out

    def get(self, name, default):
        return self.flags.get(name, default)

    def changes_voxels(self):
        """Whether some voxels take other labels than merging gives them."""
        return bool({"drop-specks", "weld"} & set(self.prepare))

    def names_labels(self):
        """Whether a run fails where the volume does not have some label."""
        return bool(self.chosen or self.merged or "weld" in self.prepare)

    def is_smooth(self):
        return self.get("surface", "smooth") == "smooth"

    def floor(self):
        """The radius ratio that no tet is below, as `kernels/quality/halved_tet.h` has it."""
        floor = float(self.get("quality-floor", "0.2"))
        for _ in range(self.halvings):
            floor = 1.79 * min(floor, 0.4) ** 2
        return repr(floor)

    def max_distance(self):
        """In voxels of the lattice; None without a bound."""
        bound = self.get("max-distance", "1.5")
        return None if bound == "none" else float(bound)


def merge(random, settings, values):
    """Unites some labels under one of theirs or a new one."""
    some = random.sample(values, min(len(values), random.randint(1, 3)))
    target = random.choice(values + [7])
    settings.merged = {label: target for label in some}
    settings.prepare["merge"] = ",".join(map(str, some)) + f"={target}"


def crop(random, settings, shape):
    lo = [random.randrange(n) for n in shape]
    hi = [random.randint(l + 1, n) for l, n in zip(lo, shape)]
    settings.crop = (lo, hi)
    settings.prepare["crop"] = ",".join(map(str, lo + hi))


def draw_prepare(random, settings, volume, values_of):
    if random.random() < 0.12:
        crop(random, settings, volume.shape)
    if random.random() < 0.10 and not volume.has_scores:
        merge(random, settings, values_of(settings))
    if random.random() < 0.10:
        settings.prepare["drop-specks"] = random.choice(["2", "5", "30", "3/26"])
    elif random.random() < 0.08 and not volume.has_scores:
        settings.prepare["weld"] = str(random.choice(values_of(settings)))


def draw_chosen(random, settings, values):
    """What is written; REQUIRES values of the prepared volume, unless voxels change labels."""
    if len(values) < 2 or settings.changes_voxels():
        return
    if random.random() < 0.08:
        some = random.sample(values, random.randint(1, len(values)))
        settings.chosen["labels"] = ",".join(map(str, some))
    elif random.random() < 0.08:
        settings.chosen["background"] = str(random.choice(values))


def draw_sizes(random, settings, values, spacing):
    """Below 0.8 diagonals of a voxel of the lattice tets are cut, at most twice."""
    if settings.get("optimizer", "local") == "tetgen" or settings.changes_voxels():
        return
    if random.random() < 0.08:
        some = random.sample(values, random.randint(1, min(3, len(values))))
        least = sum(h * h for h in spacing) ** 0.5 * 0.8

        settings.halvings = random.choice([0, 0, 0, 1, 1, 2])
        shortest = f"{least * random.uniform(1.01, 1.9) / 2 ** settings.halvings:.6g}"

        def size():
            return f"{least * random.uniform(1.01, 5):.6g}"

        rules = [f"{label}={size()}" for label in some]
        if random.random() < 0.4:
            rules.append(random.choice(["*=", ""]) + size())
        if len(some) > 1 and random.random() < 0.4:
            rules.append(f"{some[0]}|{some[1]}={size()}")
        if random.random() < 0.2:
            rules = rules[-1:]
        if settings.halvings > 0:
            rules[-1] = rules[-1].rpartition("=")[0] + "=" * ("=" in rules[-1]) + shortest
        settings.flags["size"] = ",".join(rules)
        if random.random() < 0.5:
            settings.flags["gradation"] = random.choice(["0", "0.2", "2"])
    if random.random() < 0.08:
        settings.flags["inner-vertices"] = None
    if random.random() < 0.05:
        settings.flags["count"] = random.choice(["500", "5000", "50000"])
    if random.random() < 0.05:
        settings.flags["across"] = random.choice(["1", "2", "4"])


def draw_connected(random, settings):
    """Only where the file tells of it: `verify` has to know."""
    if settings.output.split(".")[1] not in KEEP_PROMISES:
        return
    if random.random() < 0.15:
        settings.flags["parts"] = random.choice(["largest", "1", "2"])
    if random.random() < 0.15:
        settings.flags["split"] = "*"
    if random.random() < 0.1 and settings.output != "m.mesh":
        settings.flags["cohesive"] = "*"
    if random.random() < 0.1:
        settings.flags["open-hinges"] = None


def draw_flags(random, settings):
    flags = settings.flags

    def at_times(name, share, values):
        if random.random() < share:
            flags[name] = random.choice(values)

    at_times("window", 0.6, [4, 6, 8, 10, 12, 16, 20, 24])
    at_times("marches", 0.3, [1, 2, 3, 4])
    at_times("order", 0.3, ["colour"])
    at_times("start", 0.4, ["coarse", "octree", "dense"])
    at_times("topology", 0.25, ["interfaces"])
    at_times("surface", 0.25, ["voxel"])
    at_times("optimizer", 0.15, ["none", "local", "local", "tetgen"])
    at_times("max-distance", 0.4, ["0.75", "1", "2", "3", "6", "none"])
    at_times("target-reduction", 0.15, ["0.001", "0.05", "0.3"])
    at_times("edge-variance", 0.15, ["0.05", "0.1", "1"])
    at_times("quality-floor", 0.4, ["0", "0.01", "0.05", "0.1", "0.25", "0.3", "0.5"])
    at_times("inner-quality", 0.2, ["0", "0.3", "0.6"])
    if not settings.is_smooth():
        flags["quality-floor"] = random.choice(["0", "0", "0.01", "0.05", "0.2"])


def draw_periodic(random, settings, volume):
    """Without what cells that repeat themselves do not have."""
    flags = settings.flags
    if "crop" in settings.prepare:
        return
    if random.random() < 0.15:
        flags["periodic"] = "".join(axis for axis in "xyz" if random.random() < 0.7) or "y"


def draw_values(random, settings, volume):
    """The file of labels is an image, too: on its own grid, also where only a part is meshed."""
    arguments = volume.arguments
    if settings.output == "m.mesh" or "--shape" in arguments or "voxel" in arguments:
        return
    if not volume.is_plain:
        return
    if random.random() < 0.15:
        statistic = random.choice(["mean", "min", "max", "mode"])
        settings.flags["sample"] = f"value={volume.file}:{statistic}"
        if settings.output == "m.msh" and random.random() < 0.5:
            settings.flags["materials"] = random.choice(["value=1", "value=7", "value=5:0:3"])


def draw(random, volume, values_of):
    """values_of(settings): labels of the volume as cropped and merged so far."""
    settings = Settings()
    draw_prepare(random, settings, volume, values_of)
    values = values_of(settings)
    draw_chosen(random, settings, values)
    draw_flags(random, settings)
    draw_sizes(random, settings, values, volume.spacing)
    draw_periodic(random, settings, volume)
    settings.output = "m." + random.choice(FORMATS + ("vtkhdf", "vtu", "mesh"))
    if random.random() < 0.1 and settings.output != "m.mesh":
        settings.flags["element"] = "tet10"
    draw_connected(random, settings)
    if settings.output == "m.msh" and random.random() < 0.3:
        settings.flags["ascii"] = None
    draw_values(random, settings, volume)
    if not volume.is_plain and not settings.chosen:
        settings.flags["background"] = "none"  # where names say that 0 is nothing, it is left out
    return settings


def verify_arguments(random, settings):
    """What `verify` is asked: all that the run promised, and no more.  The file tells which labels
    it holds, whatever its format."""
    out = [f"--{name}={value}" for name, value in settings.prepare.items()]
    if random.random() < 0.5:
        out += [f"--{name}={value}" for name, value in settings.chosen.items()]
    tells = settings.output.split(".")[1] in KEEP_PROMISES
    if not tells or random.random() < 0.3:
        bound = settings.get("max-distance", "1.5")
        floor = settings.floor()
        out += [f"--max-distance={bound}", f"--quality-floor={floor}"]
        if not settings.chosen:
            out.append(f"--topology={settings.get('topology', 'labels')}")
    if not tells and not promises_volumes(settings):
        out.append("--max-volume-error=none")
    return out


def promises_volumes(settings):
    """P8 is for smooth surfaces under a distance bound and with an optimiser, and for floors from
    0.05 to 0.3 under shapes: with one of 0 labels of 1,400 to 5,500 voxels were off by 7 to 12 %."""
    if settings.max_distance() is None or not settings.is_smooth():
        return False
    if settings.get("optimizer", "local") == "none":
        return False
    return 0.05 <= float(settings.get("quality-floor", "0.2")) <= 0.3
