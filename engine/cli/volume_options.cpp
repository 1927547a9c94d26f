// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Options about the input volume, shared by all subcommands that read one.
#include "engine/cli/volume_options.h"

#include <algorithm>

#include "engine/cli/values.h"
#include "io/file/errors.h"
#include "io/names/read_names.h"
#include "io/volume/decode.h"
#include "io/volume/file_space.h"
#include "io/volume/open_volume.h"
#include "kernels/core/error.h"

namespace mw::cli {
namespace {

std::array<double, 3> parse_spacing(const std::string& text) {
  const std::array<double, 3> spacing = parse_numbers(text);
  if (*std::min_element(spacing.begin(), spacing.end()) > 0) return spacing;
  throw Error(ErrorKind::kUsage, "spacing must be positive");
}

io::MergeRule parse_rule(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == text.npos) throw Error(ErrorKind::kUsage, "expected A,B=C, got '" + text + "'");
  const std::string to = text.substr(equals + 1);
  return {.from = parse_labels(text.substr(0, equals)),
          .to = parse_label(to),
          .to_is_negative = to.front() == '-'};
}

std::vector<io::MergeRule> parse_merge(const std::string& text) {
  std::vector<io::MergeRule> rules;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(';', begin), text.size());
    rules.push_back(parse_rule(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return rules;
}

io::SpeckRule parse_specks(const std::string& text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  const std::string joined = text.substr(slash);
  const std::int64_t min = parse_integer(std::string_view(text).substr(0, slash));
  const bool fits = min >= 1 && static_cast<std::uint64_t>(min) <= io::SpeckRule::kMax;
  if (fits && (joined.empty() || joined == "/6" || joined == "/26")) {
    return {.min = static_cast<std::uint64_t>(min), .diagonal = joined == "/26"};
  }
  throw Error(ErrorKind::kUsage, "expected voxels, from 1 on, or voxels/26");
}

void add_raw_options(OptionSet& options, VolumeRequest& request) {
  options.add({.name = "shape",
               .value = "X,Y,Z",
               .help = "voxels along each axis; says that the file is raw",
               .kind = ValueKind::kShape,
               .assign = [&](const std::string& text) { request.shape = parse_shape(text); }});
  options.add(
      {.name = "dtype",
       .help = "voxel type of a raw file: u8 u16 u32 u64 i8 i16 i32 i64 f32 f64",
       .choices = {"u8", "u16", "u32", "u64", "i8", "i16", "i32", "i64", "f32", "f64"},
       .assign = [&](const std::string& text) { request.type = io::parse_voxel_type(text); }});
  options.add({.name = "endian",
               .help = "byte order of a raw file: little or big; little unless given",
               .choices = {"little", "big"},
               .assign = [&](const std::string& text) {
                 request.order = text == "big" ? io::ByteOrder::kBig : io::ByteOrder::kLittle;
               }});
}

int parse_scale(const std::string& text) {
  constexpr std::int64_t kMaxScale = 1000;
  const std::int64_t scale = parse_integer(text);
  if (scale >= 0 && scale <= kMaxScale) return static_cast<int>(scale);
  throw Error(ErrorKind::kUsage, "expected a level from 0 (the finest) to 1000");
}

void add_place_options(OptionSet& options, VolumeRequest& request) {
  options.add({.name = "spacing",
               .value = "X,Y,Z",
               .help = "voxel spacing in physical units instead of the file's",
               .kind = ValueKind::kNumbers,
               .assign = [&](const std::string& text) { request.spacing = parse_spacing(text); }});
  options.add({.name = "origin",
               .value = "X,Y,Z",
               .help =
                   "position of the volume's (with --crop: the box's) first corner instead of the "
                   "file's",
               .kind = ValueKind::kNumbers,
               .assign = [&](const std::string& text) { request.origin = parse_numbers(text); }});
  options.add({.name = "frame",
               .help =
                   "world of the coordinates: the file's own; ras or lps, which a file in one of "
                   "them is turned to; voxel, spacing times voxel corner",
               .fallback = "file",
               .choices = {"file", "ras", "lps", "voxel"},
               .assign = [&](const std::string& text) {
                 request.frame = io::parse_frame_choice(text).value();
               }});
}

void add_array_options(OptionSet& options, VolumeRequest& request) {
  options.add(
      {.name = "dataset",
       .value = "PATH",
       .help = "array within a file or store that holds several: " + io::formats_with_datasets(),
       .assign = [&](const std::string& text) { request.dataset = text; }});
  options.add({.name = "scale",
               .value = "N",
               .help = io::text("resolution level of a store that has several, 0 the finest: ",
                                io::formats_with_scales()),
               .kind = ValueKind::kInteger,
               .assign = [&](const std::string& text) { request.scale = parse_scale(text); }});
}

void add_step_options(OptionSet& options, VolumeRequest& request) {
  options.add({.name = "crop",
               .value = "X0,Y0,Z0,X1,Y1,Z1",
               .help = "takes the box from the first voxel to before the second; it stays where it "
                       "lies, unless --origin is given",
               .kind = ValueKind::kBox,
               .assign = [&](const std::string& text) { request.crop = parse_box(text); }});
  options.add(
      {.name = "merge",
       .value = "A,B=C;D=E",
       .help = "then labels A and B become C, which may be a label of the volume or new, and "
               "D becomes E",
       .assign = [&](const std::string& text) { request.steps.merge = parse_merge(text); }});
  options.add(
      {.name = "drop-specks",
       .value = "N",
       .help =
           "then components of fewer than N voxels, joined by faces, take the label that most "
           "of their faces touch, in rounds, components found anew after each: with N = 2 the row "
           "1 1 1 2 1 3 4 4 becomes 1 1 1 1 1 4 4 4; N/26: joined by edges and corners as well",
       .kind = ValueKind::kIntegerOrText,
       .assign = [&](const std::string& text) { request.steps.specks = parse_specks(text); }});
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
               .help = io::text("labelled volume: ", io::volume_endings(),
                                ", raw with --shape, or a folder: ", io::volume_folders()),
               .flags = "INPUT,--input",
               .assign = [&](const std::string& text) { path = text; }});
}

void add_volume_options(OptionSet& options, VolumeRequest& request) {
  add_place_options(options, request);
  add_raw_options(options, request);
  add_array_options(options, request);
  add_step_options(options, request);
  options.add({.name = "names",
               .value = "FILE",
               .help = "names and colours of labels: ITK-SNAP label description, FreeSurfer or "
                       "Slicer colour table, or CSV with columns id and name",
               .assign = [&](const std::string& text) { request.names = text; }});
}

io::OpenOptions open_options(const VolumeRequest& request) {
  require_path(request.path, "INPUT");
  io::OpenOptions options{.spacing = request.spacing,
                          .origin = request.origin,
                          .frame = request.frame,
                          .dataset = request.dataset,
                          .scale = request.scale,
                          .crop = request.crop,
                          .cache_bytes = request.cache_bytes};
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
