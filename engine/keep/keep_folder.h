// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The folder in which a run leaves what later runs may use: whose it is, and of which settings.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/keep/keep_options.h"
#include "engine/store/journal/work_file.h"
#include "io/file/file_descriptor.h"

namespace mw::engine {

/// A folder with
///     lock          held (flock) by the process that works here
///     settings.txt  what the facts here depend on beside the labels: lines "name = value"
///     versions      bytes of blocks (window_pack.h), where the records say
///     windows       what went into windows and came out (record_log.h, window_records.h)
///     labels        the labels of the run that was complete last (kept_labels.h)
///     chosen.txt    what the last run chose by itself
///     limit.txt     bytes that all this may take when a run ends; not there: any number
///     mesh.txt      how large the mesh of the run was that was complete last
///     changing      boxes that runs which were not complete may have seen changed, a line each
///     part-N        such a folder, of the Nth process beside the first (kept_part()); the first
///                   one takes it over when the run ends, or when the next one begins
/// and, while a run goes on, files without a name; nothing else.  It stays when the run ends.
class KeepFolder : public WorkFiles {
 public:
  /// ERRORS: mw::Error(kUsage) when the folder holds something and the use is kBegin, when it holds
  /// nothing and the use is kUpdate, when another process is at work here, when it has files of
  /// others, or cannot be made.
  KeepFolder(const std::filesystem::path& path, KeepUse use);

  /// What is here is of these settings from now on.
  /// ERRORS: mw::Error(kUsage) when it is of other ones; each difference is named.
  void settle(const std::string& settings) const;

  [[nodiscard]] std::unique_ptr<WorkFile> open(const std::string& name) override;
  /// A file without a name.
  [[nodiscard]] std::unique_ptr<WorkFile> open_scratch() const;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// A file of labels of this size replaces the one that is here when the run is complete.
  void expect_labels(std::uint64_t bytes) { coming_labels_ = bytes; }
  /// Bytes of all its files, once such labels have their place.
  [[nodiscard]] std::uint64_t bytes() const;

  /// The folders of other processes that are here.
  [[nodiscard]] std::vector<std::filesystem::path> parts() const;

  /// A small file as a whole; empty: it is not there.
  [[nodiscard]] std::string text(const char* name) const;
  void put_text(const char* name, const std::string& text) const;

  /// A run begins that may see other labels than the run that was complete last, outside of `boxes`
  /// none.  Returns these boxes, and those of runs in between that were not complete; durable then.
  [[nodiscard]] std::vector<Box3> begin_change(const std::vector<Box3>& boxes) const;
  /// The run is complete, and its labels have the place of those before.
  void end_change() const;

 private:
  void make(KeepUse use) const;
  void lock();

  std::filesystem::path path_;
  std::optional<std::uint64_t> coming_labels_;
  io::FileDescriptor lock_;
};

/// Changes with what is in the files; it is one of the settings, so a folder of another is refused.
inline constexpr int kFolderFormat = 3;

/// Where a process of a run keeps what it does: in `folder` itself if it is the first, rank 0.
[[nodiscard]] std::filesystem::path kept_part(const std::filesystem::path& folder, int rank);

inline constexpr const char* kVersionsFile = "versions";
inline constexpr const char* kWindowsFile = "windows";
inline constexpr const char* kLabelsFile = "labels";
inline constexpr const char* kChosenFile = "chosen.txt";
inline constexpr const char* kLimitFile = "limit.txt";
inline constexpr const char* kMeshFile = "mesh.txt";

}  // namespace mw::engine
