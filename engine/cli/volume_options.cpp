// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Options about the input volume, shared by all subcommands that read one.
#include "engine/cli/volume_options.h"

#include <algorithm>

#include "engine/cli/values.h"
#include "io/names/named_volume.h"
#include "io/names/read_names.h"
#include "io/volume/open_volume.h"
#include "io/volume/voxel_type.h"
#include "kernels/core/error.h"

namespace mw::cli {
namespace {

std::array<double, 3> parse_spacing(const std::string& text) {
  const std::array<double, 3> spacing = parse_numbers(text);
  if (*std::min_element(spacing.begin(), spacing.end()) > 0) return spacing;
  throw Error(ErrorKind::kUsage, "spacing must be positive");
}

void add_raw_options(OptionSet& options, VolumeRequest& request) {
  options.add({.name = "shape",
               .value = "X,Y,Z",
               .help = "voxels along each axis; says that the file is raw",
               .kind = ValueKind::kShape,
               .assign = [&](const std::string& text) { request.shape = parse_shape(text); }});
  options.add(
      {.name = "dtype",
       .value = "TYPE",
       .help = "voxel type of a raw file: u8 u16 u32 u64 i8 i16 i32 i64 f32 f64",
       .choices = {"u8", "u16", "u32", "u64", "i8", "i16", "i32", "i64", "f32", "f64"},
       .assign = [&](const std::string& text) { request.type = io::parse_voxel_type(text); }});
  options.add({.name = "endian",
               .value = "ORDER",
               .help = "byte order of a raw file: little or big; little unless given",
               .choices = {"little", "big"},
               .assign = [&](const std::string& text) {
                 request.order = text == "big" ? io::ByteOrder::kBig : io::ByteOrder::kLittle;
               }});
  options.add(
      {.name = "dataset", .value = "PATH", .help = "dataset within an HDF5 file", .today = ""});
}

io::RawLayout raw_layout(const VolumeRequest& request) {
  if (!request.type) throw Error(ErrorKind::kUsage, "--shape: a raw file needs --dtype as well");
  return {.shape = *request.shape,
          .type = *request.type,
          .order = request.order.value_or(io::ByteOrder::kLittle)};
}

}  // namespace

void add_input_option(OptionSet& options, std::filesystem::path& path) {
  options.add({.name = "input",
               .value = "INPUT",
               .help = "labelled volume: .npy .nii .nrrd .nhdr, each also as .gz, or raw",
               .flags = "INPUT,--input",
               .assign = [&](const std::string& text) { path = text; }});
}

void add_volume_options(OptionSet& options, VolumeRequest& request) {
  options.add({.name = "spacing",
               .value = "X,Y,Z",
               .help = "voxel spacing in physical units instead of the file's",
               .kind = ValueKind::kNumbers,
               .assign = [&](const std::string& text) { request.spacing = parse_spacing(text); }});
  options.add({.name = "origin",
               .value = "X,Y,Z",
               .help = "position of the volume's first corner instead of the file's",
               .kind = ValueKind::kNumbers,
               .assign = [&](const std::string& text) { request.origin = parse_numbers(text); }});
  add_raw_options(options, request);
  options.add({.name = "names",
               .value = "FILE",
               .help = "names and colours of labels: ITK-SNAP label description, FreeSurfer or "
                       "Slicer colour table, or CSV with columns id and name",
               .assign = [&](const std::string& text) { request.names = text; }});
}

io::OpenOptions open_options(const VolumeRequest& request) {
  require_path(request.path, "INPUT");
  io::OpenOptions options{.spacing = request.spacing, .origin = request.origin};
  if (request.shape) {
    options.raw = raw_layout(request);
  } else if (request.type || request.order) {
    throw Error(ErrorKind::kUsage, "--dtype and --endian are for raw files, which need --shape");
  }
  return options;
}

std::unique_ptr<io::LabelVolume> open(const VolumeRequest& request) {
  auto volume = io::open_volume(request.path, open_options(request));
  if (request.names.empty()) return volume;
  return std::make_unique<io::NamedVolume>(std::move(volume), io::read_names(request.names));
}

void require_path(const std::filesystem::path& path, const char* name) {
  if (path.empty()) throw Error(ErrorKind::kUsage, std::string(name) + " is missing; see --help");
}

}  // namespace mw::cli
