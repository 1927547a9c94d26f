// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The work folder: whose it is, which run it belongs to, and whether it stays.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/settings/settings.h"
#include "engine/store/journal/work_file.h"
#include "io/file/file_descriptor.h"
#include "io/volume/label_volume.h"

namespace mw::engine {

inline constexpr const char* kBlocksFile = "blocks";
inline constexpr const char* kJournalFile = "journal";

/// A folder with
///     lock          held (flock) by the process that works here
///     settings.txt  what the result depends on, a line each: "name = value"
///     blocks        bytes of blocks, engine/store/codec/block_codec.h, where the journal says
///     journal       engine/store/journal/journal.h
/// and, while the run goes on, files without a name (PreparedLabels); nothing else.
class Workdir : public WorkFiles {
 public:
  /// Makes the folder, or takes over one whose run has ended.  Work saved there is gone on with
  /// when `resume` is set.  What was never saved (a run killed early) is thrown away silently.
  /// ERRORS: mw::Error(kUsage) when saved work is there but resume is not set, or when it belongs
  /// to other settings (each difference is named), when another process is at work here, when the
  /// folder holds files of others, or cannot be made; kResource as WorkFile.
  Workdir(const std::filesystem::path& path, bool resume, const std::string& settings);
  /// Removes the folder unless keep() was called or saved work was found in it.
  ~Workdir() override;
  Workdir(const Workdir&) = delete;
  Workdir& operator=(const Workdir&) = delete;

  [[nodiscard]] std::unique_ptr<WorkFile> open(const std::string& name) override;

  /// Saved work was found: the journal has records.
  [[nodiscard]] bool resumes() const { return resumes_; }
  /// The folder stays, for a later run to go on from.
  void keep() { keep_ = true; }
  /// The run is done and the folder with it.
  void discard() { keep_ = false; }

 private:
  void make_folder();
  void refuse_files_of_others() const;
  void lock();
  [[nodiscard]] bool has_saved_work();
  void check_settings(const std::string& settings) const;
  void start_afresh(const std::string& settings);
  void remove_files() const;

  std::filesystem::path path_;
  io::FileDescriptor lock_;
  bool resumes_ = false;
  bool keep_ = false;
};

/// What a small file of a run says; of a damaged one, which may be anything, the first 16 MiB.
[[nodiscard]] std::string settings_in(const std::filesystem::path& file);

/// A value among the settings in a folder, by its name; none: it has no such value.
[[nodiscard]] std::optional<std::string> saved_value(const std::filesystem::path& path,
                                                     const std::string& name);

/// Whether a folder's settings are these, all of them.
[[nodiscard]] bool is_identity_of(const std::filesystem::path& path, const std::string& settings);

/// "window was 32 and is 64; ..." for lines "name = value" that differ; empty when none does.
[[nodiscard]] std::string differences(const std::string& before, const std::string& now);

/// A line "name = value" for shape, type and space of the volume and for each entry of
/// setting_table().  The caller adds what it knows of the program and the labels (StoreOptions):
/// mwmesh its version, and a fingerprint of the labels after --crop, --merge and --drop-specks.
///
/// Not part of it, since the tets of the work folder are the same: which labels are written, how,
/// with which names and nodes; threads, memory and how often work is saved.  Nor is the program
/// that triangulates for Optimizer::kTetgen: it is built with this one and of its version, and
/// who names another (MW_CODT_WORKER) between two parts of a run gets the tets of both.
[[nodiscard]] std::string identity_text(const io::VolumeInfo& volume, const MeshSettings& settings);

}  // namespace mw::engine
