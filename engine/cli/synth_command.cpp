// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh synth: synthetic labelled volumes of any size, written in bounded memory.
#include <CLI/CLI.hpp>
#include <algorithm>

#include "engine/cli/commands.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/values.h"
#include "io/volume/decode.h"
#include "io/volume/npy_writer.h"
#include "kernels/core/error.h"
#include "kernels/synth/synth.h"

namespace mw::cli {
namespace {

constexpr std::int64_t kSlabVoxels = 1 << 20;

struct SynthJob {
  std::string kind;
  std::string shape;
  std::string type;
  std::string output;
  std::uint64_t labels = 0;
  std::uint64_t seed = 0;
};

SynthSpec spec_of(const SynthJob& job) {
  const std::optional<SynthKind> kind = parse_synth_kind(job.kind);
  if (!kind) throw Error(ErrorKind::kUsage, "KIND " + job.kind + " is not known; see --help");
  const SynthSpec spec{
      .kind = *kind, .shape = parse_shape(job.shape), .labels = job.labels, .seed = job.seed};
  check_synth_spec(spec);
  return spec;
}

/// The narrowest type that holds the label N.
io::VoxelType type_for(std::uint64_t labels) {
  if (labels <= 0xff) return io::VoxelType::kU8;
  if (labels <= 0xffff) return io::VoxelType::kU16;
  return labels <= 0xffffffff ? io::VoxelType::kU32 : io::VoxelType::kU64;
}

io::VoxelType type_of(const SynthJob& job) {
  if (job.type.empty()) return type_for(job.labels);
  const std::optional<io::VoxelType> type = io::parse_voxel_type(job.type);
  if (!type || io::is_float(*type)) {
    throw Error(ErrorKind::kUsage, "--dtype " + job.type + ": expected u8 to u64");
  }
  return *type;
}

int run_synth(const SynthJob& job) {
  const SynthSpec spec = spec_of(job);
  if (std::filesystem::path(job.output).extension() != ".npy") {
    throw Error(ErrorKind::kUsage, "-o " + job.output + ": volumes are written as .npy");
  }
  io::VolumeInfo info;
  info.shape = spec.shape;
  info.type = type_of(job);
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

}  // namespace

void add_synth_command(CLI::App& program, Action& chosen) {
  CLI::App* command = program.add_subcommand("synth", "writes a synthetic labelled volume");
  const auto job = std::make_shared<SynthJob>();
  command->add_option("KIND", job->kind, "what it looks like")
      ->type_name("voronoi|tubes|spheres|noise|checkerboard")
      ->required();
  command->add_option("--shape", job->shape, "voxels X,Y,Z")->required();
  command->add_option("--labels", job->labels, "number of labels")->required();
  command->add_option("--seed", job->seed, "another seed, another volume")->required();
  command->add_option("--dtype", job->type, "u8 to u64; the narrowest that fits unless given");
  command->add_option("-o,--output", job->output, "file to write: .npy")->required();
  command->callback([job, &chosen] { chosen = [job] { return run_synth(*job); }; });
}

}  // namespace mw::cli
