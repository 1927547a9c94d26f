// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where surfaces go: a file, a file for each label, a folder.
#include "engine/cli/surface/surface_request.h"

#include <filesystem>
#include <set>

#include "engine/cli/options/file_names.h"
#include "engine/cli/requests.h"
#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/surface/open_surface.h"
#include "io/surface/surface_names.h"

namespace mw::cli {
namespace {

class FileOutput : public SurfaceOutput {
 public:
  explicit FileOutput(const std::string& path) : sink_(io::open_surface_sink(path)) {}

  std::unique_ptr<io::SurfaceSink> sink(RawLabel, const std::string&, const std::string&) override {
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

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

/// None of the files gets its name before all are whole.
class EachFileOutput : public SurfaceOutput {
 public:
  explicit EachFileOutput(const SurfaceRequest& request)
      : pattern_(request.output), force_(request.force) {}

  std::unique_ptr<io::SurfaceSink> sink(RawLabel, const std::string& digits,
                                        const std::string& title) override {
    std::string name = pattern_;
    replace_all(name, kLabelPlaceholder, digits);
    replace_all(name, kNamePlaceholder, io::file_word(title));
    if (!names_.insert(name).second) {
      io::fail_usage("-o ", pattern_, ": two labels would be ", name, "; put ", kLabelPlaceholder,
                     " into the name");
    }
    const std::filesystem::path path(name), whole = replaceable(path);
    if (!force_) require_own_file({"-o", whole});
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
  bool force_;
  std::set<std::string> names_;
  std::vector<Waiting> waiting_;
};

class FolderOutput : public SurfaceOutput {
 public:
  explicit FolderOutput(const SurfaceRequest& request) : folder_(request.output, request.folder) {}

  void begin(const std::string& unit) override { folder_.use_unit(unit); }
  std::unique_ptr<io::SurfaceSink> sink(RawLabel label, const std::string&,
                                        const std::string&) override {
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
      return std::make_unique<EachFileOutput>(request);
    case SurfaceTarget::kFile:
      break;
  }
  return std::make_unique<FileOutput>(request.output);
}

}  // namespace mw::cli
