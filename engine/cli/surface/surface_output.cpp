// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where surfaces go.
#include "engine/cli/surface/surface_output.h"

#include <cerrno>
#include <filesystem>

#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/surface/open_surface.h"

namespace mw::cli {
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
