// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A folder in which a run leaves what a later one goes on from: whose it is, which settings its
// files depend on, and whether it stays.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/store/journal/work_file.h"
#include "io/file/file_descriptor.h"

namespace mw::engine {

inline constexpr const char* kBlocksFile = "blocks";
inline constexpr const char* kJournalFile = "journal";

/// What tells folders of one kind from others: their files, and how refusals are worded.  The words
/// are those of a work folder unless it says otherwise.
struct FolderKind {
  /// All files in the order in which they go, so that a kill on the way leaves nothing that looks
  /// like saved work: without the first one there is nothing to go on from.  The last is kLockFile.
  std::span<const char* const> files;
  /// Optional: whether a first file that is there has something to go on from.
  bool (*is_saved)(const std::filesystem::path& first) = nullptr;
  /// Optional: whether runs make this entry of the folder, too.
  bool (*is_part)(const std::filesystem::path& entry) = nullptr;
  bool outlives_runs = false;  ///< a run that did not make the folder does not remove it
  const char* name = "work folder";
  const char* other = "another --workdir";
  const char* foreign = "is no work folder of mwmesh";
  const char* saved =
      "holds the saved work of a run that did not end; add --resume to go on with it, or delete "
      "the folder to start again; --force replaces outputs, not this work";
  const char* differs = "cannot go on, its work is that of another run";
  const char* same = "input and settings";
  const char* again = "to start again";
};

/// A folder with a lock, held by the process that works here (folder_lock.h), settings.txt (lines
/// "name = value", identity.h), the other files of its kind, and, while a run goes on, files
/// without a name; nothing else.  What a run that was killed early left is removed silently.
class RunFolder : public WorkFiles {
 public:
  /// Makes the folder, or takes over one whose run has ended.  kind outlives it.
  /// ERRORS: mw::Error(kUsage) when saved work is there but goes_on is not set, when another
  /// process is at work here, when the folder holds files of others, or cannot be made; kResource
  /// when a file cannot be removed.
  RunFolder(const std::filesystem::path& path, const FolderKind& kind, bool goes_on);
  /// Removes files and folder unless saved work was found or stay() called, and not discard().
  ~RunFolder() override;
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  /// Saves the settings that the files here depend on, or checks that they are the saved ones.
  /// ERRORS: mw::Error(kUsage) when they are not; each difference is named.
  void settle(const std::string& settings) const;

  [[nodiscard]] std::unique_ptr<WorkFile> open(const std::string& name) override;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Returns the text of a small file; empty where it is not there.
  [[nodiscard]] std::string text(const char* name) const;
  void put_text(const char* name, const std::string& text) const;

  /// True if saved work was found.
  [[nodiscard]] bool resumes() const { return resumes_; }
  /// Makes the folder stay, for a later run to go on from.
  void stay() { stays_ = true; }
  /// Makes the folder go, since the run is done.  From here on there is nothing to go on from.
  void discard();

 protected:
  [[noreturn]] void refuse(const std::string& why) const;
  [[nodiscard]] std::vector<std::filesystem::path> entries() const;

 private:
  RunFolder(const std::filesystem::path& path, const FolderKind& kind);
  void make();
  void lock();
  [[nodiscard]] bool is_own(const std::filesystem::path& entry) const;
  [[nodiscard]] bool is_file(const std::string& name) const;
  [[nodiscard]] bool is_left_over(const std::string& name) const;
  void clear_away() const;

  std::filesystem::path path_;
  const FolderKind& kind_;
  io::FileDescriptor lock_;
  bool is_made_ = false;  ///< there was no folder before
  bool resumes_ = false;
  bool stays_ = true;
};

/// The work folder of a process.  Beside lock and settings it has
///     blocks        bytes of blocks, engine/store/codec/block_codec.h, where the journal says
///     journal       engine/store/journal/journal.h; saved work is a record in it
class Workdir : public RunFolder {
 public:
  /// Opens the folder and settles it.
  Workdir(const std::filesystem::path& path, bool resume, const std::string& settings);
};

}  // namespace mw::engine
