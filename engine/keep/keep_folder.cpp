// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Making, locking and checking the folder.
#include "engine/keep/keep_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <sstream>

#include "engine/store/journal/mapped_file.h"
#include "engine/store/journal/workdir.h"
#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/file/sink/atomic_file.h"

namespace mw::engine {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLockFile = "lock";
constexpr const char* kSettingsFile = "settings.txt";
constexpr const char* kChangingFile = "changing";
constexpr const char* kPartPrefix = "part-";
constexpr std::array<const char*, 9> kFiles{kLockFile,    kSettingsFile, kVersionsFile,
                                            kWindowsFile, kLabelsFile,   kChosenFile,
                                            kLimitFile,   kMeshFile,     kChangingFile};

/// True for the name of a file that a kill in an unlucky instant leaves.
bool is_left_over(const std::string& name) {
  return name.find(".partial-") != name.npos || name.starts_with(io::kScratchPrefix);
}

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw Error(ErrorKind::kUsage, path.string() + ": " + why);
}

}  // namespace

KeepFolder::KeepFolder(const fs::path& path, KeepUse use)
    : path_(fs::absolute(path).lexically_normal()) {
  if (!path_.has_filename()) path_ = path_.parent_path();
  make(use);
  lock();
  const bool holds_something = fs::exists(path_ / kSettingsFile);
  if (holds_something && use == KeepUse::kBegin) {
    refuse(path_,
           "holds what an earlier run has kept; go on with it by --from, or delete the folder");
  }
  if (!holds_something && use == KeepUse::kUpdate) {
    refuse(path_, "holds nothing that a run has kept; begin it by --keep");
  }
}

void KeepFolder::make(KeepUse use) const {
  if (use == KeepUse::kUpdate && !fs::is_directory(path_)) {
    refuse(path_, "is no folder; begin it by --keep");
  }
  if (::mkdir(path_.c_str(), 0777) == 0) return;
  if (errno != EEXIST) io::fail_output(path_.string(), "create the folder", errno);
  if (!fs::is_directory(path_)) refuse(path_, "is not a folder; give --keep another name");
  for (const auto& entry : fs::directory_iterator(path_)) {
    const std::string name = entry.path().filename().string();
    const bool is_file = std::find(kFiles.begin(), kFiles.end(), name) != kFiles.end();
    if (is_file || name.starts_with(kPartPrefix) || is_left_over(name)) continue;
    refuse(path_, "was not made by --keep: it holds " + name + "; give an empty or a new folder");
  }
}

void KeepFolder::lock() {
  const fs::path path = path_ / kLockFile;
  lock_ = io::FileDescriptor(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
  if (!lock_.valid()) io::fail_output(path.string(), "create", errno);
  if (::flock(lock_.get(), LOCK_EX | LOCK_NB) == 0) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(path_, ignored)) {
      if (is_left_over(entry.path().filename().string())) fs::remove(entry.path(), ignored);
    }
    return;
  }
  if (errno != EWOULDBLOCK) io::fail_output(path.string(), "lock", errno);
  refuse(path_, "another mwmesh is at work here; wait for it or give another folder");
}

void KeepFolder::settle(const std::string& settings) const {
  if (!fs::exists(path_ / kSettingsFile)) {
    for (const char* name : {kWindowsFile, kVersionsFile, kLabelsFile}) fs::remove(path_ / name);
    io::AtomicFile file(path_ / kSettingsFile);
    file.append(settings);
    file.commit();
    return;
  }
  const std::string before = settings_in(path_ / kSettingsFile);
  if (before == settings) return;
  const std::string different = differences(before, settings);
  if (different.empty()) {
    refuse(path_, io::text("its ", kSettingsFile, " is damaged: delete the folder and use --keep"));
  }
  refuse(path_, "is of another run: " + different +
                    "; give the same settings, or delete the folder and begin it by --keep");
}

std::vector<fs::path> KeepFolder::parts() const {
  std::vector<fs::path> out;
  for (const auto& entry : fs::directory_iterator(path_)) {
    if (entry.path().filename().string().starts_with(kPartPrefix)) out.push_back(entry.path());
  }
  std::sort(out.begin(), out.end());
  return out;
}

fs::path kept_part(const fs::path& folder, int rank) {
  return rank == 0 ? folder : folder / io::text(kPartPrefix, rank);
}

std::string KeepFolder::text(const char* name) const {
  return settings_in(path_ / name);
}

void KeepFolder::put_text(const char* name, const std::string& text) const {
  io::AtomicFile file(path_ / name);
  file.append(text);
  file.commit();
}

std::vector<Box3> KeepFolder::begin_change(const std::vector<Box3>& boxes) const {
  std::vector<Box3> all = boxes;
  std::istringstream before(settings_in(path_ / kChangingFile));
  for (Box3 box; before >> box.lo.x >> box.lo.y >> box.lo.z >> box.hi.x >> box.hi.y >> box.hi.z;) {
    all.push_back(box);
  }
  io::AtomicFile file(path_ / kChangingFile);
  for (const Box3& b : all) {
    file.append(
        io::text(b.lo.x, " ", b.lo.y, " ", b.lo.z, " ", b.hi.x, " ", b.hi.y, " ", b.hi.z, "\n"));
  }
  file.commit();
  return all;
}

void KeepFolder::end_change() const {
  fs::remove(path_ / kChangingFile);
}

std::unique_ptr<WorkFile> KeepFolder::open(const std::string& name) {
  return std::make_unique<MappedFile>(path_ / name);
}

std::unique_ptr<WorkFile> KeepFolder::open_scratch() const {
  const fs::path path = path_ / ".blocks.partial-spilled";
  auto file = std::make_unique<MappedFile>(path);
  fs::remove(path);
  return file;
}

std::uint64_t KeepFolder::bytes() const {
  std::uint64_t sum = coming_labels_.value_or(0);
  for (const char* name : kFiles) {
    if (coming_labels_ && name == std::string_view(kLabelsFile)) continue;
    std::error_code failed;
    const std::uintmax_t size = fs::file_size(path_ / name, failed);
    if (!failed) sum += size;
  }
  return sum;
}

}  // namespace mw::engine
