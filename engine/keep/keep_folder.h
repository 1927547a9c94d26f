// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The folder in which a run leaves what later runs may use: whose it is, and of which settings.
#pragma once

#include <filesystem>
#include <string>

#include "engine/keep/keep_options.h"
#include "engine/store/journal/work_file.h"
#include "io/file/file_descriptor.h"

namespace mw::engine {

/// A folder with
///     lock          held (flock) by the process that works here
///     settings.txt  what the facts here depend on beside the labels: lines "name = value"
///     versions      bytes of blocks (kept_block.h), packed, where the records say
///     windows       what went into windows and came out (record_log.h, window_records.h)
///     labels        the labels of the run that was complete last (label_state.h)
/// and, while a run goes on, files without a name; nothing else.  It stays when the run ends.
class KeepFolder : public WorkFiles {
 public:
  /// ERRORS: mw::Error(kUsage) when the folder holds something and the use is kBegin, when it holds
  /// nothing and the use is kUpdate, when it is of other settings (each difference is named), when
  /// another process is at work here, when it has files of others, or cannot be made.
  KeepFolder(const std::filesystem::path& path, KeepUse use, const std::string& settings);

  [[nodiscard]] std::unique_ptr<WorkFile> open(const std::string& name) override;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Bytes of all its files.
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  void make(KeepUse use) const;
  void lock();
  void check_settings(const std::string& settings) const;

  std::filesystem::path path_;
  io::FileDescriptor lock_;
};

inline constexpr const char* kVersionsFile = "versions";
inline constexpr const char* kWindowsFile = "windows";
inline constexpr const char* kLabelsFile = "labels";

}  // namespace mw::engine
