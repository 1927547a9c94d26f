// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Making, locking and checking the folder.
#include "engine/keep/keep_folder.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <numeric>
#include <random>
#include <sstream>

#include "engine/store/journal/folder_lock.h"
#include "engine/store/journal/mapped_file.h"
#include "engine/store/journal/workdir.h"
#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/file/sink/atomic_file.h"

namespace mw::engine {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNumberFile = "number.txt";
constexpr const char* kSettingsFile = "settings.txt";
constexpr const char* kChangingFile = "changing";
constexpr const char* kPartPrefix = "part-";
constexpr std::array<const char*, 9> kFiles{kLockFile,     kNumberFile,  kSettingsFile,
                                            kVersionsFile, kWindowsFile, kLabelsFile,
                                            kChosenFile,   kLimitFile,   kChangingFile};

constexpr const char* kSpilled = ".blocks.partial-spilled";

/// Beyond this number of boxes the one around them takes their place, so that the file stays small.
constexpr std::size_t kMostBoxes = 1 << 14;

/// Returns the boxes of a file, none if it does not exist.  ERRORS: DamagedWork, also for the file
/// of a folder with another number.
std::vector<Box3> boxes_in(const fs::path& path, std::uint64_t folder) {
  std::vector<Box3> out;
  if (!fs::exists(path)) return out;
  std::istringstream text(settings_in(path));
  std::uint64_t number = 0;
  if (text >> number && number != folder) {
    throw DamagedWork(kChangingFile, "it is of another folder");
  }
  for (Box3 b; text >> b.lo.x >> b.lo.y >> b.lo.z >> b.hi.x >> b.hi.y >> b.hi.z;) out.push_back(b);
  if (out.empty() || !text.eof()) throw DamagedWork(kChangingFile, "it does not list boxes");
  return out;
}

bool is_kept_file(std::string_view name) {
  return std::find(kFiles.begin(), kFiles.end(), name) != kFiles.end();
}

/// True for the name of a file that a kill in an unlucky instant leaves.
bool is_left_over(std::string_view name) {
  if (name == kSpilled || name.starts_with(io::kScratchPrefix)) return true;
  const std::size_t end = name.find(".partial-");
  return end != name.npos && name.starts_with(".") && is_kept_file(name.substr(1, end - 1));
}

/// True for the folder of another process (kept_part()).
bool is_part(const fs::path& path) {
  const std::string name = path.filename().string();
  if (!name.starts_with(kPartPrefix)) return false;
  const std::string_view rank = std::string_view(name).substr(std::string_view(kPartPrefix).size());
  const bool is_number = !rank.empty() && std::all_of(rank.begin(), rank.end(),
                                                      [](char c) { return c >= '0' && c <= '9'; });
  return is_number && is_of_runs(path);
}

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  io::fail_usage(path.string() + ": " + why);
}

fs::path whole(const fs::path& path) {
  std::error_code failed;
  const fs::path out = fs::absolute(path, failed).lexically_normal();
  if (failed) refuse(path, "there is no working folder: " + failed.message());
  return out;
}

fs::directory_iterator entries(const fs::path& folder) {
  std::error_code failed;
  fs::directory_iterator out(folder, failed);
  if (failed) refuse(folder, "cannot list it: " + failed.message());
  return out;
}

/// False for a path that cannot be looked at.
bool is_folder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

}  // namespace

KeepFolder::KeepFolder(const fs::path& path) : path_(whole(path)) {}

/// What throws behind the other constructor is followed by the destructor.
KeepFolder::KeepFolder(const fs::path& path, KeepUse use) : KeepFolder(path) {
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
  stays_ = holds_something;
  number_ = number_of(path_);
  if (holds_something || number_ != 0) return;
  std::random_device system;
  const std::uint64_t high = system();
  number_ = high << 32U | system();
  put_text(kNumberFile, io::text(number_, "\n"));
}

/// A run that was refused leaves nothing in the way of the next one.
KeepFolder::~KeepFolder() {
  try {
    if (!stays_ && parts().empty()) remove_files();
  } catch (const Error&) {
    // The folder cannot be listed, so nothing is known to be superfluous.
  }
}

/// The lock goes last: files without it would look like somebody else's.
void KeepFolder::remove_files() const {
  std::error_code ignored;
  for (const char* name : kFiles) {
    if (name != std::string_view(kLockFile)) fs::remove(path_ / name, ignored);
  }
  fs::remove(path_ / kLockFile, ignored);
  if (is_made_) ::rmdir(path_.c_str());
}

void KeepFolder::make(KeepUse use) {
  if (use == KeepUse::kUpdate && !is_folder(path_)) {
    refuse(path_, "is no folder; begin it by --keep");
  }
  is_made_ = ::mkdir(path_.c_str(), 0777) == 0;
  if (is_made_) return;
  if (errno != EEXIST) io::fail_output(path_.string(), "create the folder", errno);
  if (!is_folder(path_)) refuse(path_, "is not a folder; give --keep another name");
  const bool may_be_ours = is_of_runs(path_);
  for (const auto& entry : entries(path_)) {
    const std::string name = entry.path().filename().string();
    if (may_be_ours && (is_kept_file(name) || is_left_over(name))) continue;
    if (is_part(entry.path())) continue;  // processes of a run begin in any order
    refuse(path_, "was not made by --keep: it holds " + name + "; give an empty or a new folder");
  }
}

void KeepFolder::lock() {
  std::optional<io::FileDescriptor> locked = lock_folder(path_);
  if (!locked) {
    refuse(path_, "another mwmesh is at work here; wait for it or give another folder");
  }
  if (!locked->valid()) refuse(path_, "was removed meanwhile; begin it by --keep");
  lock_ = std::move(*locked);
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(path_, ignored)) {
    if (is_left_over(entry.path().filename().string())) fs::remove(entry.path(), ignored);
  }
}

void KeepFolder::settle(const std::string& settings) const {
  if (!fs::exists(path_ / kSettingsFile)) {
    for (const char* name : {kWindowsFile, kVersionsFile, kLabelsFile}) fs::remove(path_ / name);
    io::AtomicFile file(path_ / kSettingsFile);
    file.append(settings);
    file.commit();
    return;
  }
  const std::string before = settings_in(path_ / kSettingsFile, settings);
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
  for (const auto& entry : entries(path_)) {
    if (is_part(entry.path())) out.push_back(entry.path());
  }
  std::sort(out.begin(), out.end());
  return out;
}

fs::path kept_part(const fs::path& folder, int rank) {
  return rank == 0 ? folder : folder / io::text(kPartPrefix, rank);
}

std::uint64_t KeepFolder::number_of(const fs::path& folder) {
  std::uint64_t out = 0;
  std::istringstream(settings_in(folder / kNumberFile)) >> out;
  return out;
}

std::string KeepFolder::text(const char* name) const {
  return settings_in(path_ / name);
}

void KeepFolder::put_text(const char* name, const std::string& text) const {
  io::AtomicFile file(path_ / name);
  file.append(text);
  file.commit();
}

std::vector<Box3> KeepFolder::with_incomplete(const std::vector<Box3>& boxes) const {
  std::vector<Box3> all = boxes;
  const std::vector<Box3> before = boxes_in(path_ / kChangingFile, number_);
  all.insert(all.end(), before.begin(), before.end());
  if (all.size() > kMostBoxes) all = {std::reduce(all.begin(), all.end(), all[0], hull)};
  return all;
}

void KeepFolder::begin_change(const std::vector<Box3>& boxes) const {
  io::AtomicFile file(path_ / kChangingFile);
  file.append(io::text(number_, "\n"));
  for (const Box3& b : with_incomplete(boxes)) {
    file.append(
        io::text(b.lo.x, " ", b.lo.y, " ", b.lo.z, " ", b.hi.x, " ", b.hi.y, " ", b.hi.z, "\n"));
  }
  file.commit();
}

void KeepFolder::end_change() const {
  fs::remove(path_ / kChangingFile);
}

std::unique_ptr<WorkFile> KeepFolder::open(const std::string& name) {
  return std::make_unique<MappedFile>(path_ / name);
}

std::unique_ptr<WorkFile> KeepFolder::open_scratch() const {
  const fs::path path = path_ / kSpilled;
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
