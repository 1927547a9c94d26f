// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The folder in which a run leaves what later runs may use.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/keep/keep_options.h"
#include "engine/store/journal/run_folder.h"

namespace mw::engine {

/// A RunFolder with
///     number.txt    number(), which `windows`, `labels` and `changing` hold, too
///     versions      bytes of blocks (window_pack.h), where the records say
///     windows       what went into windows and came out (RecordLog, window_records.h)
///     labels        the run that was complete last: its labels, how large its mesh was, and what
///                   it did with the labels before it meshed them (kept_labels.h)
///     chosen.txt    what the last run chose by itself
///     limit.txt     bytes that all this may take when a run ends; if missing, any number
///     changing      boxes in which incomplete runs may have seen other labels, a line each
///     part-N        the folder of process N (kept_part()), with the same files; the first process
///                   takes it over when the run ends, or when the next one begins
/// Saved work is what settings.txt says: those that the facts here depend on beside the labels.
class KeepFolder : public RunFolder {
 public:
  /// ERRORS: those of RunFolder; mw::Error(kUsage) when the folder holds nothing and the use is
  /// kUpdate.
  KeepFolder(const std::filesystem::path& path, KeepUse use);
  /// Files stay where those of other processes are in their folders.
  ~KeepFolder() override;
  KeepFolder(const KeepFolder&) = delete;
  KeepFolder& operator=(const KeepFolder&) = delete;

  /// Returns what tells this folder from others: the system drew it when a run first began here. It
  /// decides on no result.
  [[nodiscard]] std::uint64_t number() const { return number_; }
  /// Returns that of a folder; 0 where there is none.
  [[nodiscard]] static std::uint64_t number_of(const std::filesystem::path& folder);

  /// Opens a file without a name.
  [[nodiscard]] std::unique_ptr<WorkFile> open_scratch() const;
  /// Says that a file of labels of this size replaces the one here when the run is complete.
  void expect_labels(std::uint64_t bytes) { coming_labels_ = bytes; }
  /// Returns the bytes of all its files, counting expected labels in the place of those here.
  [[nodiscard]] std::uint64_t bytes() const;

  /// Returns the folders of other processes that are here.
  [[nodiscard]] std::vector<std::filesystem::path> parts() const;

  /// Returns these boxes, and those in which incomplete runs may have seen other labels than the
  /// run that was complete last.
  [[nodiscard]] std::vector<Box3> with_incomplete(const std::vector<Box3>& boxes) const;
  /// Begins a run that may see other labels than the run that was complete last, but only inside
  /// with_incomplete(boxes), which is durable then.
  void begin_change(const std::vector<Box3>& boxes) const;
  /// Ends a run that is complete, once its labels have replaced those of the last complete one.
  void end_change() const;

 private:
  std::uint64_t number_ = 0;
  std::optional<std::uint64_t> coming_labels_;
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
