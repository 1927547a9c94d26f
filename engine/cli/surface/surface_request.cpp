// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The options of mwmesh surface, and where surfaces go.
#include "engine/cli/surface/surface_request.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>

#include "engine/cli/options/shared_options.h"
#include "engine/cli/options/values.h"
#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/surface/open_surface.h"

namespace mw::cli {
namespace {

constexpr const char* kSurfaceGroup = "Which surfaces";

[[noreturn]] void fail(const std::string& message) {
  io::fail_usage(message);
}

std::vector<RawLabel> parse_label_list(const std::string& text) {
  std::vector<RawLabel> labels;
  for (const RawLabel label : parse_labels(text)) {
    if (std::find(labels.begin(), labels.end(), label) == labels.end()) labels.push_back(label);
  }
  return labels;
}

std::array<RawLabel, 2> parse_pair(const std::string& text) {
  const std::vector<RawLabel> labels = parse_labels(text);
  if (labels.size() != 2 || labels[0] == labels[1]) fail("expected two labels, as --pair 1,2");
  return {labels[0], labels[1]};
}

/// Returns the format by --format, else by the extension; a path without one is a folder.
std::string format_of(const SurfaceFlags& flags) {
  const std::string extension = std::filesystem::path(flags.output).extension().string();
  if (flags.format.empty()) {
    if (extension.empty()) return "precomputed";
    if (io::is_surface_path(flags.output)) return extension.substr(1);
    fail("-o " + flags.output + ": extension '" + extension +
         "' is no surface format known here; supported are " + io::surface_extensions() +
         ", and a folder of precomputed meshes, which needs --format precomputed or draco if its "
         "name has an extension");
  }
  if (is_folder_format(flags.format)) return flags.format;
  if (!io::is_surface_path("x." + flags.format)) {
    fail("--format " + flags.format + ": expected stl, ply, precomputed or draco");
  }
  if (io::is_surface_path(flags.output) && extension != "." + flags.format) {
    fail("--format " + flags.format + " and -o " + flags.output + " contradict each other");
  }
  return flags.format;
}

bool names_each(const SurfaceFlags& flags) {
  return flags.each || flags.output.find(kLabelPlaceholder) != std::string::npos;
}

/// Returns the pattern of file names: the output if it has `{label}`, else files in that folder.
std::string pattern_of(const SurfaceFlags& flags, const std::string& format) {
  if (flags.output.find(kLabelPlaceholder) != std::string::npos) return flags.output;
  if (io::is_surface_path(flags.output)) {
    fail("-o " + flags.output + ": with --each the name needs " + kLabelPlaceholder +
         " where the label goes, as -o 'parts/" + kLabelPlaceholder + "." + format +
         "'; or give a folder and --format " + format);
  }
  return (std::filesystem::path(flags.output) / (std::string(kLabelPlaceholder) + "." + format))
      .string();
}

void set_target(const SurfaceFlags& flags, SurfaceRequest& request) {
  const std::string format = format_of(flags);
  if (is_folder_format(format)) {
    if (request.pair) fail("--pair: precomputed meshes are surfaces of labels; write .ply or .stl");
    if (flags.output.find(kLabelPlaceholder) != std::string::npos) {
      fail("-o " + flags.output + ": one folder of precomputed meshes holds all labels");
    }
    request.target = SurfaceTarget::kFolder;
    if (format == "draco") request.folder.kind = io::FragmentKind::kDraco;
    request.folder.closed = request.closed;
    if (!flags.unit.empty() && !io::nm_in(flags.unit)) {
      fail("--unit " + flags.unit + ": expected nm, um, mm or m");
    }
    request.unit = flags.unit;
    return;
  }
  if (!flags.unit.empty()) fail("--unit: only precomputed meshes have a unit, nm");
  if (names_each(flags)) {
    request.target = SurfaceTarget::kEachFile;
    request.output = pattern_of(flags, format);
  } else if (!io::is_surface_path(flags.output)) {
    fail("-o " + flags.output + ": the name needs the extension ." + format);
  }
}

void add_output_options(OptionSet& options, SurfaceFlags& flags) {
  options.add({.name = "output",
               .value = "OUTPUT",
               .help = "file: " + io::surface_extensions() + "; or a folder of precomputed meshes",
               .group = kOutputGroup,
               .flags = "-o,--output",
               .required = true,
               .assign = into(flags.output)});
  options.add({.name = "each",
               .help = "a file for each label, as -o 'parts/{label}.stl' says by itself",
               .group = kOutputGroup,
               .kind = ValueKind::kSwitch,
               .assign = into(flags.each)});
  options.add({.name = "format",
               .value = "FORMAT",
               .help = "stl, ply, precomputed or draco [by the extension]",
               .group = kOutputGroup,
               .assign = into(flags.format)});
  options.add({.name = "unit",
               .value = "UNIT",
               .help = "nm, um, mm or m: of the mesh, for precomputed meshes [its own, or nm]",
               .group = kOutputGroup,
               .assign = into(flags.unit)});
}

}  // namespace

void add_surface_options(OptionSet& options, SurfaceFlags& flags) {
  add_mesh_option(options, flags.mesh, "mesh to read");
  options.add({.name = "labels",
               .value = "LIST",
               .help = "the surface of each of these, with what lies on the box",
               .group = kSurfaceGroup,
               .kind = ValueKind::kLabels,
               .flags = "--labels,--label",
               .assign = into(flags.labels, parse_label_list)});
  options.add({.name = "pair",
               .value = "A,B",
               .help = "the interface of these two",
               .group = kSurfaceGroup,
               .kind = ValueKind::kLabels,
               .assign = into(flags.pair, parse_pair)});
  options.add({.name = "open",
               .help = "without what lies on the sides of the box",
               .group = kSurfaceGroup,
               .kind = ValueKind::kSwitch,
               .assign = into(flags.open)});
  options.add({.name = "manifold",
               .help = "doubles vertices where a surface touches itself or another one",
               .group = kSurfaceGroup,
               .kind = ValueKind::kSwitch,
               .assign = into(flags.manifold)});
  add_output_options(options, flags);
}

SurfaceRequest parse_surface_request(const SurfaceFlags& flags) {
  SurfaceRequest request{.mesh = flags.mesh.string(),
                         .output = flags.output,
                         .folder = {},
                         .labels = flags.labels,
                         .pair = flags.pair,
                         .manifold = flags.manifold,
                         .closed = !flags.open};
  if (flags.pair && (!flags.labels.empty() || names_each(flags))) {
    fail(std::string("--pair: not together with --labels, --each or ") + kLabelPlaceholder);
  }
  set_target(flags, request);
  return request;
}

namespace {

class FileOutput : public SurfaceOutput {
 public:
  explicit FileOutput(const std::string& path) : sink_(io::open_surface_sink(path)) {}

  std::unique_ptr<io::SurfaceSink> sink(RawLabel, const std::string&) override {
    return std::move(sink_);
  }
  void finish(const io::LabelNames&) override {}

 private:
  std::unique_ptr<io::SurfaceSink> sink_;
};

/// Returns the path, or the file that it links to; throws, as AtomicFile does, for what is no file.
std::filesystem::path replaceable(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    io::fail_usage(path.string() + ": cannot create: exists and is no file");
  }
  return std::filesystem::is_symlink(path, ignored) ? std::filesystem::weakly_canonical(path)
                                                    : path;
}

/// None of the files gets its name before all are whole.
class EachFileOutput : public SurfaceOutput {
 public:
  explicit EachFileOutput(std::string pattern) : pattern_(std::move(pattern)) {}

  std::unique_ptr<io::SurfaceSink> sink(RawLabel, const std::string& digits) override {
    const std::string_view position(kLabelPlaceholder);
    std::string name = pattern_;
    for (std::size_t at = name.find(position); at != name.npos; at = name.find(position, at)) {
      name.replace(at, position.size(), digits);
    }
    const std::filesystem::path path(name), whole = replaceable(path);
    std::error_code failed;
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), failed);
    if (failed) io::fail_output(path.parent_path().string(), "create", failed.value());
    // The extension stays, as it says the format.
    const std::string waits = io::kScratchPrefix + ("each-" + path.filename().string());
    waiting_.push_back({whole.parent_path() / waits, whole});
    return io::open_surface_sink(waiting_.back().now);
  }
  void finish(const io::LabelNames&) override {
    std::string complete;
    for (const Waiting& file : waiting_) {
      std::error_code failed;
      std::filesystem::rename(file.now, file.name, failed);
      const std::string beside = complete.empty() ? "" : " (complete are " + complete + ")";
      if (failed) io::fail_output(file.name.string() + beside, "rename to", failed.value());
      complete += (complete.empty() ? "" : ", ") + file.name.string();
    }
    waiting_.clear();
  }
  ~EachFileOutput() override {
    std::error_code ignored;
    for (const Waiting& file : waiting_) std::filesystem::remove(file.now, ignored);
  }

 private:
  struct Waiting {
    std::filesystem::path now, name;
  };

  std::string pattern_;
  std::vector<Waiting> waiting_;
};

class FolderOutput : public SurfaceOutput {
 public:
  explicit FolderOutput(const SurfaceRequest& request) : folder_(request.output, request.folder) {}

  void begin(const std::string& unit) override { folder_.use_unit(unit); }
  std::unique_ptr<io::SurfaceSink> sink(RawLabel label, const std::string&) override {
    return folder_.sink(label);
  }
  void finish(const io::LabelNames& names) override { folder_.finish(names); }

 private:
  io::MeshFolder folder_;
};

}  // namespace

bool is_folder_format(std::string_view format) {
  return format == "precomputed" || format == "draco";
}

std::unique_ptr<SurfaceOutput> open_surface_output(const SurfaceRequest& request) {
  switch (request.target) {
    case SurfaceTarget::kFolder:
      return std::make_unique<FolderOutput>(request);
    case SurfaceTarget::kEachFile:
      return std::make_unique<EachFileOutput>(request.output);
    case SurfaceTarget::kFile:
      break;
  }
  return std::make_unique<FileOutput>(request.output);
}

}  // namespace mw::cli
