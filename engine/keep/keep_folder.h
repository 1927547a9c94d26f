// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The folder in which a run leaves what later runs may use: who works in it, for which settings.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/keep/keep_options.h"
#include "engine/store/journal/work_file.h"
#include "io/file/file_descriptor.h"

namespace mw::engine {

/// A folder with
///     lock          held by the process that works here (folder_lock.h)
///     number.txt    number(), which `windows`, `labels` and `changing` hold, too
///     settings.txt  what the facts here depend on beside the labels: lines "name = value"
///     versions      bytes of blocks (window_pack.h), where the records say
///     windows       what went into windows and came out (RecordLog, window_records.h)
///     labels        the run that was complete last: its labels, how large its mesh was, and what
///                   it did with the labels before it meshed them (kept_labels.h)
///     chosen.txt    what the last run chose by itself
///     limit.txt     bytes that all this may take when a run ends; if missing, any number
///     changing      boxes in which incomplete runs may have seen other labels, a line each
///     part-N        the folder of process N (kept_part()), with the same files; the first process
///                   takes it over when the run ends, or when the next one begins
/// and, while a run goes on, files without a name; nothing else.  It stays when the run ends,
/// unless it held nothing before and stay() was not called: then these files go, and the folder,
/// too, if this object made it.
class KeepFolder : public WorkFiles {
 public:
  /// ERRORS: mw::Error(kUsage) when the folder holds something and the use is kBegin, when it holds
  /// nothing and the use is kUpdate, when another process is at work here, when it has files of
  /// others, or cannot be made.
  KeepFolder(const std::filesystem::path& path, KeepUse use);
  ~KeepFolder() override;
  KeepFolder(const KeepFolder&) = delete;
  KeepFolder& operator=(const KeepFolder&) = delete;

  /// Says that a later run can use what is here.
  void stay() { stays_ = true; }

  /// Returns what tells this folder from others: the system drew it when a run first began here. It
  /// decides on no result.
  [[nodiscard]] std::uint64_t number() const { return number_; }
  /// Returns that of a folder; 0 where there is none.
  [[nodiscard]] static std::uint64_t number_of(const std::filesystem::path& folder);

  /// Saves the settings that the facts here depend on, or checks that they are the saved ones.
  /// ERRORS: mw::Error(kUsage) when they are not; each difference is named.
  void settle(const std::string& settings) const;

  [[nodiscard]] std::unique_ptr<WorkFile> open(const std::string& name) override;
  /// Opens a file without a name.
  [[nodiscard]] std::unique_ptr<WorkFile> open_scratch() const;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Says that a file of labels of this size replaces the one here when the run is complete.
  void expect_labels(std::uint64_t bytes) { coming_labels_ = bytes; }
  /// Returns the bytes of all its files, counting expected labels in the place of those here.
  [[nodiscard]] std::uint64_t bytes() const;

  /// Returns the folders of other processes that are here.
  [[nodiscard]] std::vector<std::filesystem::path> parts() const;

  /// Returns the text of a small file; empty where it is not there.
  [[nodiscard]] std::string text(const char* name) const;
  void put_text(const char* name, const std::string& text) const;

  /// Returns these boxes, and those in which incomplete runs may have seen other labels than the
  /// run that was complete last.
  [[nodiscard]] std::vector<Box3> with_incomplete(const std::vector<Box3>& boxes) const;
  /// Begins a run that may see other labels than the run that was complete last, but only inside
  /// with_incomplete(boxes), which is durable then.
  void begin_change(const std::vector<Box3>& boxes) const;
  /// Ends a run that is complete, once its labels have replaced those of the last complete one.
  void end_change() const;

 private:
  explicit KeepFolder(const std::filesystem::path& path);
  void make(KeepUse use);
  void lock();
  void remove_files() const;

  std::filesystem::path path_;
  std::uint64_t number_ = 0;
  std::optional<std::uint64_t> coming_labels_;
  io::FileDescriptor lock_;
  bool is_made_ = false;  ///< there was no folder before
  bool stays_ = true;
};

/// The version of what is in the files.  It is one of the settings, so a folder of another version
/// is refused.
inline constexpr int kFolderFormat = 6;

/// Returns where a process of a run keeps what it does: in `folder` itself if it is rank 0.
[[nodiscard]] std::filesystem::path kept_part(const std::filesystem::path& folder, int rank);

inline constexpr const char* kVersionsFile = "versions";
inline constexpr const char* kWindowsFile = "windows";
inline constexpr const char* kLabelsFile = "labels";
inline constexpr const char* kChosenFile = "chosen.txt";
inline constexpr const char* kLimitFile = "limit.txt";

}  // namespace mw::engine
