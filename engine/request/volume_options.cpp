// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Options about the input volume, shared by all subcommands that read one.
#include "engine/request/volume_options.h"

#include <algorithm>
#include <sstream>

#include "engine/request/shared_options.h"
#include "engine/request/values.h"
#include "engine/system/crew.h"
#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/names/read_names.h"
#include "io/volume/checks.h"
#include "io/volume/decode.h"
#include "io/volume/open_volume.h"

namespace mw::request {
namespace {

std::array<double, 3> parse_spacing(const std::string& text) {
  const std::array<double, 3> spacing = parse_numbers(text);
  if (!std::ranges::all_of(spacing, [](double edge) { return edge > 0; })) {
    io::fail_usage("expected positive numbers");
  }
  return spacing;
}

io::MergeRule parse_rule(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == text.npos) io::fail_usage("expected A,B=C, got '" + text + "'");
  const std::string to = text.substr(equals + 1);
  return {.from = parse_labels(text.substr(0, equals)),
          .to = parse_label(to),
          .to_is_negative = to.front() == '-'};
}

std::vector<io::MergeRule> parse_merge(const std::string& text) {
  std::vector<io::MergeRule> rules;
  for (const std::string_view rule : io::split_at(';', text)) {
    rules.push_back(parse_rule(std::string(rule)));
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
  io::fail_usage("expected voxels, from 1 on, or voxels/26");
}

void set_order(VolumeRequest& request, const std::string& text) {
  request.order = text == "big" ? io::ByteOrder::kBig : io::ByteOrder::kLittle;
}

/// Parses "u16", or with a byte order "u16be" or "u16le".
void parse_dtype(VolumeRequest& request, const std::string& text) {
  const bool is_big = text.ends_with("be"), has_order = is_big || text.ends_with("le");
  request.type = io::parse_voxel_type(text.substr(0, text.size() - (has_order ? 2 : 0)));
  if (!request.type) {
    io::fail_usage("expected u8 u16 u32 u64 i8 i16 i32 i64 f32 or f64; u16be is big-endian");
  }
  if (has_order) set_order(request, is_big ? "big" : "little");
}

void add_raw_options(OptionSet& options, VolumeRequest& request) {
  options.add({.name = "shape",
               .value = "X,Y,Z",
               .help = "voxels along each axis; says that the file is raw",
               .group = kInputGroup,
               .kind = ValueKind::kShape,
               .calls = kOpening,
               .assign = into(request.shape, parse_shape)});
  options.add({.name = "dtype",
               .value = "TYPE",
               .help = "of raw voxels: u8 to u64, i8 to i64, f32, f64; u16be: big-endian",
               .group = kInputGroup,
               .calls = kOpening,
               .assign = [&](const std::string& text) { parse_dtype(request, text); }});
  options.add({.name = "endian",
               .choices = {"little", "big"},
               .listed = Listed::kNowhere,
               .assign = [&](const std::string& text) { set_order(request, text); }});
}

int parse_scale(const std::string& text) {
  constexpr std::int64_t kMaxScale = 1000;
  const std::int64_t scale = parse_integer(text);
  if (scale >= 0 && scale <= kMaxScale) return static_cast<int>(scale);
  io::fail_usage("expected a level from 0 (the finest) to 1000");
}

void add_place_options(OptionSet& options, VolumeRequest& request) {
  options.add({.name = "spacing",
               .value = "X,Y,Z|H",
               .help = "spacing of voxels in physical units [the file's]",
               .group = kInputGroup,
               .kind = ValueKind::kNumbers,
               .calls = kOpening,
               .assign = into(request.open.spacing, parse_spacing)});
  options.add({.name = "origin",
               .value = "X,Y,Z",
               .help = "where the first corner, or that of --crop, lies [the file's]",
               .group = kInputGroup,
               .kind = ValueKind::kNumbers,
               .calls = kOpening,
               .listed = Listed::kInHelpAll,
               .assign = into(request.open.origin, parse_numbers)});
  options.add({.name = "frame",
               .value = "FRAME",
               .help = "world: file: its own; ras; lps; voxel: spacing times corner",
               .group = kInputGroup,
               .fallback = "file",
               .choices = {"file", "ras", "lps", "voxel"},
               .calls = kOpening,
               .listed = Listed::kInHelpAll,
               .assign = into(request.open.frame, chosen(io::parse_frame_choice))});
  options.add({.name = "use-form",
               .value = "FORM",
               .help = "place of a NIfTI file that has two [sform, else qform]",
               .group = kInputGroup,
               .choices = {"sform", "qform"},
               .calls = kOpening,
               .listed = Listed::kInHelpAll,
               .assign = into(request.open.form, chosen(io::parse_form_choice))});
}

void add_array_options(OptionSet& options, VolumeRequest& request) {
  options.add({.name = "dataset",
               .value = "PATH",
               .help = "which array, where a file has several",
               .group = kInputGroup,
               .calls = kOpening,
               .assign = into(request.open.dataset)});
  options.add({.name = "scale",
               .value = "N",
               .help = "which level of an image pyramid, 0 the finest",
               .group = kInputGroup,
               .kind = ValueKind::kInteger,
               .calls = kOpening,
               .listed = Listed::kInHelpAll,
               .assign = into(request.open.scale, parse_scale)});
}

}  // namespace

void add_step_options(OptionSet& options, VolumeRequest& request) {
  options.add({.name = "merge",
               .value = "A,B=C;D=E",
               .help = "labels A and B become C, and D becomes E, all at once",
               .group = kLabelGroup,
               .calls = kMeshing | kVerifying,
               .has_labels = true,
               .assign = into(request.steps.merge, parse_merge)});
  options.add({.name = "drop-specks",
               .value = "N",
               .help = "parts below N voxels join a neighbour; N/26: parts join at corners",
               .group = kLabelGroup,
               .kind = ValueKind::kNumberOrText,
               .calls = kMeshing | kVerifying,
               .assign = into(request.steps.specks, parse_specks)});
  options.add(
      switch_of(request.steps.interpolate,
                {.name = "interpolate-slices",
                 .help = "labels between thick slices, for smooth surfaces instead of steps",
                 .group = kLabelGroup,
                 .calls = kMeshing | kVerifying,
                 .listed = Listed::kInHelpAll}));
  options.add({.name = "weld",
               .value = "A,B",
               .help = "fill voxels of A and B where others meet by an edge or corner alone",
               .group = kLabelGroup,
               .calls = kMeshing | kVerifying,
               .listed = Listed::kInHelpAll,
               .has_labels = true,
               .assign = into(request.steps.weld, parse_labels)});
  options.add({.name = "names",
               .value = "FILE",
               .help = "names: ITK-SNAP, FreeSurfer, Slicer, CSV, dataset.json, class map",
               .group = kLabelGroup,
               .calls = kOpening,
               .assign = into(request.names)});
}

void add_input_option(OptionSet& options, std::filesystem::path& path) {
  options.add({.name = "input",
               .value = "INPUT",
               .help = "labelled volume: file, folder, address; raw with --shape, --dtype",
               .group = kInputGroup,
               .flags = "INPUT,--input",
               .face = Face::kProgram,
               .required = true,
               .assign = into(path)});
}

void add_volume_options(OptionSet& options, VolumeRequest& request) {
  add_place_options(options, request);
  add_raw_options(options, request);
  add_array_options(options, request);
  options.add({.name = "overlap",
               .value = "RULE",
               .help = "the label of a voxel in several masks; all: one for each set",
               .group = kInputGroup,
               .choices = {"first", "last", "all"},
               .calls = kOpening,
               .listed = Listed::kInHelpAll,
               .assign = into(request.open.overlap, chosen(io::parse_overlap))});
  options.add({.name = "values",
               .value = "KIND",
               .help = "labels, a probability a class, or a distance a label",
               .group = kInputGroup,
               .fallback = "labels",
               .choices = {"labels", "probabilities", "distances"},
               .calls = kOpening,
               .listed = Listed::kInHelpAll,
               .assign = into(request.open.values, chosen(io::parse_voxel_values))});
  options.add({.name = "crop",
               .value = "X0,Y0,Z0,X1,Y1,Z1",
               .help = "the box from the first voxel to before the second",
               .group = kInputGroup,
               .kind = ValueKind::kBox,
               .calls = kOpening,
               .assign = into(request.open.crop, parse_box)});
  options.add({.name = "object",
               .value = "LIST",
               .help = "only these labels, found by coarser scales; all others become 0",
               .group = kInputGroup,
               .kind = ValueKind::kLabels,
               .calls = kOpening | kMeshing,
               .listed = Listed::kInHelpAll,
               .assign = into(request.open.object, parse_labels)});
  options.add({.name = "cache",
               .value = "DIR[,SIZE]",
               .help = "keeps what servers send, at most 10GiB: chunks are fetched once",
               .group = kInputGroup,
               .calls = kOpening,
               .listed = Listed::kInHelpAll,
               .assign = into(request.open.cache, engine::parse_cache_folder)});
  options.add(switch_of(request.open.trust_paths,
                        {.name = "trust-paths",
                         .help = "files that headers name may be outside of their folder",
                         .group = kInputGroup,
                         .calls = kOpening,
                         .listed = Listed::kInHelpAll}));
}

std::string volume_note() {
  constexpr std::size_t kWidth = 100;
  const std::string all =
      io::text(io::volume_endings(), ", and folders: ", io::volume_folders(), ".");
  std::string out = "Volumes:", line;
  std::istringstream words(all);
  for (std::string word; words >> word;) {
    if (line.size() + 1 + word.size() > kWidth) {
      out += "\n" + line;
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return out + "\n" + line + "\n";
}

}  // namespace mw::request
