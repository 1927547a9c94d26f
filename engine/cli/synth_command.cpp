// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh synth: synthetic labelled volumes of any size, written in bounded memory.
#include <algorithm>

#include "engine/cli/command.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/options/file_names.h"
#include "engine/cli/options/mesh_options.h"
#include "engine/cli/requests.h"
#include "io/file/errors.h"
#include "io/volume/decode.h"
#include "io/volume/npy/open_npy.h"
#include "kernels/synth/synth.h"

namespace mw::cli {
namespace {

constexpr std::int64_t kSlabVoxels = 1 << 20;

struct SynthJob {
  SynthSpec spec;
  std::optional<io::VoxelType> type;  ///< empty: the narrowest that fits
  std::filesystem::path output;
  bool force = false;  ///< whether it may replace a file
};

/// Returns the narrowest type that holds the largest label, which may be the number of labels.
io::VoxelType type_for(std::uint64_t labels) {
  if (labels <= 0xff) return io::VoxelType::kU8;
  if (labels <= 0xffff) return io::VoxelType::kU16;
  return labels <= 0xffffffff ? io::VoxelType::kU32 : io::VoxelType::kU64;
}

io::VoxelType parse_dtype(const std::string& text) {
  const std::optional<io::VoxelType> type = io::parse_voxel_type(text);
  if (!type || io::is_float(*type)) io::fail_usage("expected u8 to u64");
  return *type;
}

/// Parses a number of labels or a seed, which may have all 64 bits.
std::uint64_t parse_count(const std::string& text) {
  std::uint64_t value = 0;
  if (!engine::read_number(text, value)) engine::fail_expected("a number from 0 on", text);
  return value;
}

int run_synth(const SynthJob& job) {
  const SynthSpec& spec = job.spec;
  check_synth_spec(spec);
  if (job.output.extension() != ".npy") {
    io::fail_usage("-o " + job.output.string() + ": volumes are written as .npy");
  }
  if (!job.force) require_own_file({"-o", job.output});
  io::VolumeInfo info;
  info.shape = spec.shape;
  info.type = job.type.value_or(type_for(spec.labels));
  io::NpyWriter writer(job.output, info);
  const std::int64_t plane = spec.shape.x * spec.shape.y;
  const std::int64_t planes = std::max<std::int64_t>(1, kSlabVoxels / plane);
  std::vector<RawLabel> slab;
  for (std::int64_t z = 0; z < spec.shape.z; z += planes) {
    const std::int64_t count = std::min(planes, spec.shape.z - z);
    slab.resize(static_cast<std::size_t>(plane * count));
    synth_slab(spec, z, count, slab);
    writer.write(slab);
  }
  writer.finish();
  return kExitDone;
}

void add_options(OptionSet& options, SynthJob& job) {
  options.add({.name = "kind",
               .value = "KIND",
               .help = "voronoi, tubes, spheres, noise or checkerboard",
               .choices = {"voronoi", "tubes", "spheres", "noise", "checkerboard"},
               .flags = "KIND,--kind",
               .required = true,
               .assign = into(job.spec.kind, chosen(parse_synth_kind))});
  options.add({.name = "shape",
               .value = "X,Y,Z",
               .help = "voxels along each axis",
               .kind = ValueKind::kShape,
               .required = true,
               .assign = into(job.spec.shape, parse_shape)});
  options.add({.name = "count",
               .value = "N",
               .help = "number of labels, of which some may have no voxel",
               .flags = "--count,--labels",
               .required = true,
               .only_flag = true,  // MW_COUNT is a number of tets
               .assign = into(job.spec.labels, parse_count)});
  options.add({.name = "seed",
               .value = "S",
               .help = "another seed, another volume",
               .required = true,
               .assign = into(job.spec.seed, parse_count)});
  options.add({.name = "output",
               .value = "OUTPUT",
               .help = "file to write: .npy",
               .flags = "-o,--output",
               .required = true,
               .assign = into(job.output)});
  options.add({.name = "dtype",
               .value = "TYPE",
               .help = "u8 to u64 [the narrowest that fits]",
               .assign = into(job.type, parse_dtype)});
  add_force_option(options, job.force);
}

}  // namespace

Command synth_command() {
  const auto job = std::make_shared<SynthJob>();
  Command command{.name = "synth",
                  .about = "writes a synthetic labelled volume",
                  .options = {},
                  .run = [job](const OptionSet&) { return run_synth(*job); },
                  .note = ""};
  add_options(command.options, *job);
  return command;
}

}  // namespace mw::cli
