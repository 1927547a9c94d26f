// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Making, locking, checking and removing a work folder; settings as lines of text.
#include "engine/store/journal/workdir.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <vector>

#include "engine/settings/setting_table.h"
#include "engine/store/journal/folder_lock.h"
#include "engine/store/journal/journal.h"
#include "engine/store/journal/mapped_file.h"
#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/file/sink/atomic_file.h"
#include "io/file/sink/partial_file.h"
#include "io/file/text_numbers.h"

namespace mw::engine {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSettingsFile = "settings.txt";
// They are in the order of removal: a kill on the way leaves nothing that looks like saved work.
constexpr std::array<const char*, 4> kFiles{kJournalFile, kBlocksFile, kSettingsFile, kLockFile};
constexpr const char* kPartialSettings = ".settings.txt.partial-";  // left by a killed AtomicFile

constexpr std::uintmax_t kMaxSettings = 16 << 20;  // those that are expected may have any size
// Sizes of many labels make long lines; those that differ are shown in part.
constexpr std::size_t kMaxShown = 120;
constexpr std::size_t kMaxTold = 8;

/// True for the name of a file that a kill in an unlucky instant leaves.
bool is_left_over(const std::string& name) {
  return name.starts_with(kPartialSettings) || name.starts_with(io::kScratchPrefix);
}

bool is_ours(const std::string& name) {
  return is_left_over(name) || std::find(kFiles.begin(), kFiles.end(), name) != kFiles.end();
}

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  io::fail_usage(path.string() + ": " + why);
}

using Lines = std::map<std::string, std::string>;

Lines lines_of(const std::string& text) {
  constexpr std::string_view kIs = " = ";
  Lines out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    const std::size_t at = line.find(kIs);
    if (at != line.npos) out[line.substr(0, at)] = line.substr(at + kIs.size());
  }
  return out;
}

std::optional<std::string> value_of(const Lines& lines, const std::string& name) {
  const auto found = lines.find(name);
  return found == lines.end() ? std::nullopt : std::optional(found->second);
}

std::string shown(const std::optional<std::string>& value) {
  return value ? io::printable(*value, kMaxShown) : "(not there)";
}

/// Returns the name of a line; that of a setting is told as the flag.
std::string told_name(const std::string& name) {
  const bool is_setting =
      std::ranges::find(setting_table(), name, &Setting::name) != setting_table().end();
  return (is_setting ? "--" : "") + io::printable(name, kMaxShown);
}

/// True if the text has only characters that identity_text() and the program write.
bool is_plain(const std::string& text) {
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); });
}

/// Removes the file if it is there.
void clear_away(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error) io::fail_output(path.string(), "remove", error.value());
}

std::string triple(const std::array<double, 3>& v) {
  return io::text(v[0], ",", v[1], ",", v[2]);
}

std::string volume_text(const io::VolumeInfo& volume) {
  const Index3 shape = volume.shape;
  const io::VolumeSpace& space = volume.space;
  return io::text("shape = ", shape.x, ",", shape.y, ",", shape.z, "\n",                    //
                  "type = ", io::name(volume.type), volume.scaled ? ", scaled" : "", "\n",  //
                  "spacing = ", triple(space.spacing), "\n",                                //
                  "axes = ", triple(space.axes[0]), " ", triple(space.axes[1]), " ",
                  triple(space.axes[2]), "\n",  //
                  "origin = ", triple(space.origin), "\n");
}

/// Whether the first corners of a volume, in one space, are within rounding where they are in
/// another.
bool is_near(const io::VolumeSpace& one, const io::VolumeSpace& other) {
  constexpr double kRounding = 1e-6;  // voxels
  for (const io::Vector3& corner : {io::Vector3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
    const io::Vector3 there = to_corner(other, to_world(one, corner));
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(std::abs(there[k] - corner[k]) <= kRounding)) return false;
    }
  }
  return true;
}

}  // namespace

std::string settings_in(const fs::path& path, std::string_view expected) {
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(path, failed);
  const std::uintmax_t most = std::max<std::uintmax_t>(kMaxSettings, expected.size() + 1);
  std::string content(failed ? 0 : std::min(size, most), '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(content.data(), static_cast<std::streamsize>(content.size()));
  content.resize(static_cast<std::size_t>(in.gcount()));
  return content;
}

std::string differences(const std::string& before, const std::string& now) {
  const Lines old_lines = lines_of(before), new_lines = lines_of(now);
  if (value_of(old_lines, "results") != value_of(new_lines, "results")) {
    return "it was made by another build of mwmesh, whose results may differ";
  }
  Lines names = old_lines;
  names.insert(new_lines.begin(), new_lines.end());
  std::string out;
  std::size_t told = 0;
  for (const auto& [name, any] : names) {
    const auto was = value_of(old_lines, name), is = value_of(new_lines, name);
    if (was == is) continue;
    if (++told > kMaxTold) continue;
    out +=
        (out.empty() ? "" : "; ") + told_name(name) + " was " + shown(was) + " and is " + shown(is);
  }
  if (told > kMaxTold) out += io::text("; and ", told - kMaxTold, " more");
  return out;
}

Workdir::Workdir(const fs::path& path, bool resume, const std::string& settings)
    : path_(fs::absolute(path).lexically_normal()) {
  if (!path_.has_filename()) path_ = path_.parent_path();
  lock();
  if (has_saved_work()) {
    resumes_ = keep_ = true;
    if (!resume) {
      refuse(path_,
             "holds the saved work of a run that did not end; add --resume to go on with "
             "it, or delete the folder to start again; --force replaces outputs, not this work");
    }
    check_settings(settings);
    return;
  }
  try {
    start_afresh(settings);
  } catch (...) {
    remove_files();
    throw;
  }
}

Workdir::~Workdir() {
  if (!keep_) remove_files();
}

std::optional<std::string> saved_value(const fs::path& path, const std::string& name) {
  return value_of(lines_of(settings_in(path / kSettingsFile)), name);
}

std::string first_voxel_text(const io::VolumeInfo& volume) {
  const Index3 first = volume.first;
  return io::text("first voxel = ", first.x, ",", first.y, ",", first.z, "\n");
}

std::string place_differences(const fs::path& path, const io::VolumeInfo& volume) {
  const Lines is = lines_of(volume_text(volume) + first_voxel_text(volume));
  std::string before, now;
  for (const char* name : {"shape", "origin", "first voxel"}) {
    const std::optional<std::string> was = saved_value(path, name);
    if (!was) return {};
    before += io::text(name, " = ", *was, "\n");
    now += io::text(name, " = ", is.at(name), "\n");
  }
  return differences(before, now);
}

io::VolumeSpace settled_space(const fs::path& path, const io::VolumeSpace& space) {
  const Lines lines = lines_of(settings_in(path / kSettingsFile));
  std::string text;
  for (const char* name : {"spacing", "axes", "origin"}) {
    text += value_of(lines, name).value_or("") + " ";
  }
  std::ranges::replace(text, ',', ' ');
  const auto numbers = io::parse_reals(text);
  if (!numbers || numbers->size() != 15) return space;
  io::VolumeSpace out = space;
  auto next = numbers->begin();
  for (io::Vector3* v : {&out.spacing, &out.axes[0], &out.axes[1], &out.axes[2], &out.origin}) {
    for (double& x : *v) x = *next++;
  }
  return is_near(space, out) ? out : space;
}

bool is_identity_of(const fs::path& path, const std::string& settings) {
  return settings_in(path / kSettingsFile, settings) == settings;
}

void Workdir::make_folder() {
  if (::mkdir(path_.c_str(), 0777) == 0) return;
  if (errno != EEXIST) io::fail_output(path_.string(), "create the work folder", errno);
  if (!fs::is_directory(path_)) refuse(path_, "is not a folder; give another --workdir");
  refuse_files_of_others();
}

void Workdir::refuse_files_of_others() const {
  // Another run may be about to make or to remove the folder, so it is looked at twice.
  const bool was_of_runs = is_of_runs(path_);
  std::error_code error;
  const fs::directory_iterator entries(path_, error);
  if (error) io::fail_output(path_.string(), "read the work folder", error.value());
  std::vector<std::string> names;
  for (const auto& entry : entries) names.push_back(entry.path().filename().string());
  const bool may_be_ours = was_of_runs || is_of_runs(path_);
  for (const std::string& name : names) {
    if (may_be_ours && is_ours(name)) continue;
    refuse(path_, "is no work folder of mwmesh: it holds " + name + "; give an empty or a new one");
  }
}

void Workdir::lock() {
  do {
    make_folder();
    std::optional<io::FileDescriptor> locked = lock_folder(path_);
    if (!locked) {
      refuse(path_, "another mwmesh is at work here; wait for it or give another --workdir");
    }
    lock_ = std::move(*locked);
  } while (!lock_.valid());
}

bool Workdir::has_saved_work() {
  if (!fs::exists(path_ / kJournalFile)) return false;
  Journal journal(open(kJournalFile));
  journal.replay([](const JournalRecord&) {});
  return journal.records() > 0;
}

void Workdir::check_settings(const std::string& settings) const {
  const std::string before = settings_in(path_ / kSettingsFile, settings);
  if (before == settings) return;
  const std::string different = differences(before, settings);
  if (different.empty() || !is_plain(before)) {
    refuse(path_, io::text("cannot go on, its ", kSettingsFile,
                           " is damaged: delete the folder to start again"));
  }
  refuse(path_, "cannot go on, its work is that of another run: " + different +
                    "; give the same input and settings, or delete the folder to start again");
}

void Workdir::start_afresh(const std::string& settings) {
  clear_away(path_ / kJournalFile);
  clear_away(path_ / kBlocksFile);
  io::AtomicFile file(path_ / kSettingsFile);
  file.append(settings);
  file.commit();
}

void Workdir::remove_files() const {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(path_, ignored)) {
    const std::string name = entry.path().filename().string();
    if (is_left_over(name)) fs::remove(entry.path(), ignored);
  }
  for (const char* name : kFiles) {
    fs::remove(path_ / name, ignored);
    // A journal that a power cut brings back without the others would look like saved work, and any
    // file without the lock like somebody else's.
    if (name == kJournalFile || name == kSettingsFile) io::sync_folder(path_);
  }
  ::rmdir(path_.c_str());  // a link to the folder stays, as somebody else made it
}

std::unique_ptr<WorkFile> Workdir::open(const std::string& name) {
  return std::make_unique<MappedFile>(path_ / name);
}

std::string identity_text(const io::VolumeInfo& volume, const MeshSettings& settings) {
  std::string out = volume_text(volume);
  for (const Setting& setting : setting_table()) {
    const std::string value = setting.text(settings);
    out += setting.name + " = " + (value.empty() ? "none" : value) + "\n";
  }
  return out;
}

}  // namespace mw::engine
