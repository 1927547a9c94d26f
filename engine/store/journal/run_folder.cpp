// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Making, locking, checking and removing a folder.
#include "engine/store/journal/run_folder.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <optional>

#include "engine/store/journal/folder_lock.h"
#include "engine/store/journal/identity.h"
#include "engine/store/journal/journal.h"
#include "engine/store/journal/mapped_file.h"
#include "io/file/errors.h"
#include "io/file/folder.h"
#include "io/file/scratch/scratch_file.h"
#include "io/file/sink/atomic_file.h"
#include "io/file/sink/partial_file.h"

namespace mw::engine {
namespace {

namespace fs = std::filesystem;

/// Returns the whole path, without a "/" at its end.
fs::path whole(const fs::path& path) {
  std::error_code failed;
  const fs::path out = fs::absolute(path, failed).lexically_normal();
  if (failed) io::fail_usage(path.string(), ": there is no working folder: ", failed.message());
  return out.has_filename() ? out : out.parent_path();
}

/// True if the text has only characters that identity_text() and the program write.
bool is_plain(const std::string& text) {
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); });
}

bool has_records(const fs::path& file) {
  Journal journal(std::make_unique<MappedFile>(file));
  journal.replay([](const JournalRecord&) {});
  return journal.records() > 0;
}

constexpr std::array kWorkFiles{kJournalFile, kBlocksFile, kSettingsFile, kLockFile};
constexpr FolderKind kWorkdir{.files = kWorkFiles, .is_saved = has_records};

}  // namespace

RunFolder::RunFolder(const fs::path& path, const FolderKind& kind)
    : path_(whole(path)), kind_(kind) {}

/// What throws behind the other constructor is followed by the destructor.
RunFolder::RunFolder(const fs::path& path, const FolderKind& kind, bool goes_on)
    : RunFolder(path, kind) {
  lock();
  const fs::path first = path_ / kind_.files.front();
  resumes_ = fs::exists(first) && (kind_.is_saved == nullptr || kind_.is_saved(first));
  if (resumes_ && !goes_on) refuse(kind_.saved);
  stays_ = resumes_;
  clear_away();
}

RunFolder::~RunFolder() {
  if (stays_) return;
  discard();
  std::error_code ignored;
  for (const char* name : kind_.files) {
    // Without the lock a file that a power cut brings back would look like somebody else's.
    if (name == std::string_view(kLockFile)) io::sync_folder(path_);
    fs::remove(path_ / name, ignored);
  }
  // A link to the folder stays, as somebody else made it.
  if (is_made_ || !kind_.outlives_runs) ::rmdir(path_.c_str());
}

void RunFolder::discard() {
  stays_ = false;
  std::error_code ignored;
  // If a power cut brought it back without the others, it would look like saved work.
  if (fs::remove(path_ / kind_.files.front(), ignored)) io::sync_folder(path_);
}

void RunFolder::refuse(const std::string& why) const {
  io::fail_usage(path_.string(), ": ", why);
}

std::vector<fs::path> RunFolder::entries() const {
  std::error_code error;
  const std::vector<std::string> names = io::entries_in(path_, error);
  if (error) io::fail_output(path_.string(), "read the folder", error.value());
  std::vector<fs::path> out;
  for (const std::string& name : names) out.push_back(path_ / name);
  return out;
}

void RunFolder::make() {
  const int error = ::mkdir(path_.c_str(), 0777) == 0 ? 0 : errno;
  is_made_ = error == 0;
  if (is_made_) return;
  std::error_code ignored;
  if (error == ENOTDIR || (error == EEXIST && !fs::is_directory(path_, ignored))) {
    refuse(io::text("is not a folder, or lies in what is none; give ", kind_.other));
  }
  if (error != EEXIST) {
    io::fail_output(path_.string(), io::text("create the ", kind_.name), error);
  }
  // Another run may be about to make or to remove the folder, so it is looked at twice.
  const bool was_of_runs = is_of_runs(path_);
  const std::vector<fs::path> found = entries();
  const bool may_be_own = was_of_runs || is_of_runs(path_);
  for (const fs::path& entry : found) {
    if (may_be_own && is_own(entry)) continue;
    refuse(io::text(kind_.foreign, ": it holds ", entry.filename().string(),
                    "; give an empty or a new one"));
  }
}

void RunFolder::lock() {
  do {
    make();
    std::optional<io::FileDescriptor> locked = lock_folder(path_);
    if (!locked) {
      refuse(io::text("another mwmesh is at work here; wait for it or give ", kind_.other));
    }
    lock_ = std::move(*locked);
  } while (!lock_.valid());
}

bool RunFolder::is_own(const fs::path& entry) const {
  const std::string name = entry.filename().string();
  return is_file(name) || is_left_over(name) || (kind_.is_part != nullptr && kind_.is_part(entry));
}

bool RunFolder::is_file(const std::string& name) const {
  return std::ranges::find(kind_.files, name) != kind_.files.end();
}

/// True for the name of a file that a kill in an unlucky instant leaves.
bool RunFolder::is_left_over(const std::string& name) const {
  return name.starts_with(io::kScratchPrefix) ||
         std::ranges::any_of(kind_.files, [&](const char* file) {
           return name.starts_with(io::text(".", file, ".partial-"));
         });
}

/// Removes what killed runs left, and without saved work all files.
void RunFolder::clear_away() const {
  for (const fs::path& entry : entries()) {
    const std::string name = entry.filename().string();
    const bool is_old = !resumes_ && is_file(name) && name != kLockFile;
    if (!is_old && !is_left_over(name)) continue;
    std::error_code error;
    fs::remove(entry, error);
    if (error) io::fail_output(entry.string(), "remove", error.value());
  }
}

void RunFolder::settle(const std::string& settings) const {
  if (!resumes_) return put_text(kSettingsFile, settings);
  const std::string before = settings_in(path_ / kSettingsFile, settings);
  if (before == settings) return;
  const std::string different = differences(before, settings);
  if (different.empty() || !is_plain(before)) {
    refuse(io::text("cannot go on, its ", kSettingsFile, " is damaged: delete the folder ",
                    kind_.again));
  }
  refuse(io::text(kind_.differs, ": ", different, "; give the same ", kind_.same,
                  ", or delete the folder ", kind_.again));
}

std::unique_ptr<WorkFile> RunFolder::open(const std::string& name) {
  return std::make_unique<MappedFile>(path_ / name);
}

std::string RunFolder::text(const char* name) const {
  return settings_in(path_ / name);
}

void RunFolder::put_text(const char* name, const std::string& text) const {
  io::AtomicFile file(path_ / name);
  file.append(text);
  file.commit();
}

Workdir::Workdir(const fs::path& path, bool resume, const std::string& settings)
    : RunFolder(path, kWorkdir, resume) {
  settle(settings);
}

}  // namespace mw::engine
