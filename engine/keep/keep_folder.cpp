// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Small files of the folder, and the folders of other processes.
#include "engine/keep/keep_folder.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <sstream>

#include "engine/store/journal/folder_lock.h"
#include "engine/store/journal/identity.h"
#include "engine/store/journal/mapped_file.h"
#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"

namespace mw::engine {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNumberFile = "number.txt";
constexpr const char* kChangingFile = "changing";
constexpr const char* kPartPrefix = "part-";

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

/// True for the folder of another process (kept_part()).
bool is_part(const fs::path& path) {
  const std::string name = path.filename().string();
  if (!name.starts_with(kPartPrefix)) return false;
  const std::string_view rank = std::string_view(name).substr(std::string_view(kPartPrefix).size());
  const bool is_number = !rank.empty() && std::all_of(rank.begin(), rank.end(),
                                                      [](char c) { return c >= '0' && c <= '9'; });
  return is_number && is_of_runs(path);
}

constexpr std::array kFiles{kSettingsFile, kNumberFile, kVersionsFile, kWindowsFile, kLabelsFile,
                            kChosenFile,   kLimitFile,  kChangingFile, kLockFile};
constexpr FolderKind kKeepFolder{
    .files = kFiles,
    .is_part = is_part,
    .outlives_runs = true,
    .name = "folder",
    .other = "another folder",
    .foreign = "was not made by --keep",
    .saved = "holds what an earlier run has kept; go on with it by --from, or delete the folder",
    .differs = "is of another run",
    .same = "settings",
    .again = "and begin it by --keep"};

/// Returns the path.  An update makes no folder.
const fs::path& found(const fs::path& path, KeepUse use) {
  std::error_code ignored;
  if (use == KeepUse::kUpdate && !fs::is_directory(path, ignored)) {
    io::fail_usage(path.string(), ": is no folder; begin it by --keep");
  }
  return path;
}

}  // namespace

KeepFolder::KeepFolder(const fs::path& path, KeepUse use)
    : RunFolder(found(path, use), kKeepFolder, use != KeepUse::kBegin),
      number_(number_of(this->path())) {
  if (resumes()) return;
  if (use == KeepUse::kUpdate) refuse("holds nothing that a run has kept; begin it by --keep");
  std::random_device system;
  const std::uint64_t high = system();
  number_ = high << 32U | system();
  put_text(kNumberFile, io::text(number_, "\n"));
}

KeepFolder::~KeepFolder() {
  try {
    if (!parts().empty()) stay();
  } catch (const Error&) {
    stay();  // The folder cannot be listed, so nothing is known to be superfluous.
  }
}

std::vector<fs::path> KeepFolder::parts() const {
  std::vector<fs::path> out;
  for (const fs::path& entry : entries()) {
    if (is_part(entry)) out.push_back(entry);
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

std::vector<Box3> KeepFolder::with_incomplete(const std::vector<Box3>& boxes) const {
  std::vector<Box3> all = boxes;
  const std::vector<Box3> before = boxes_in(path() / kChangingFile, number_);
  all.insert(all.end(), before.begin(), before.end());
  if (all.size() > kMostBoxes) all = {std::reduce(all.begin(), all.end(), all[0], hull)};
  return all;
}

void KeepFolder::begin_change(const std::vector<Box3>& boxes) const {
  std::string out = io::text(number_, "\n");
  for (const Box3& b : with_incomplete(boxes)) {
    out += io::text(b.lo.x, " ", b.lo.y, " ", b.lo.z, " ", b.hi.x, " ", b.hi.y, " ", b.hi.z, "\n");
  }
  put_text(kChangingFile, out);
}

void KeepFolder::end_change() const {
  fs::remove(path() / kChangingFile);
}

std::unique_ptr<WorkFile> KeepFolder::open_scratch() const {
  const fs::path file = path() / io::text(io::kScratchPrefix, "spilled");
  auto out = std::make_unique<MappedFile>(file);
  fs::remove(file);
  return out;
}

std::uint64_t KeepFolder::bytes() const {
  std::uint64_t sum = coming_labels_.value_or(0);
  for (const char* name : kFiles) {
    if (coming_labels_ && name == std::string_view(kLabelsFile)) continue;
    std::error_code failed;
    const std::uintmax_t size = fs::file_size(path() / name, failed);
    if (!failed) sum += size;
  }
  return sum;
}

}  // namespace mw::engine
