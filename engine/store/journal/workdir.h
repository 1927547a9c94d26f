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
///     lock          held by the process that works here (folder_lock.h)
///     settings.txt  what the result depends on, a line each: "name = value"
///     blocks        bytes of blocks, engine/store/codec/block_codec.h, where the journal says
///     journal       engine/store/journal/journal.h
/// and, while the run goes on, files without a name (PreparedLabels); nothing else.
class Workdir : public WorkFiles {
 public:
  /// Makes the folder, or takes over one whose run has ended.  `resume` allows to go on with work
  /// saved there.  What a run that was killed early left without a record is removed silently.
  /// ERRORS: mw::Error(kUsage) when saved work is there but resume is not set, or when it belongs
  /// to other settings (each difference is named), when another process is at work here, when the
  /// folder holds files of others, or cannot be made; kResource when a file cannot be written.
  Workdir(const std::filesystem::path& path, bool resume, const std::string& settings);
  /// Removes the folder unless keep() was called, or saved work was found and discard() not called.
  ~Workdir() override;
  Workdir(const Workdir&) = delete;
  Workdir& operator=(const Workdir&) = delete;

  [[nodiscard]] std::unique_ptr<WorkFile> open(const std::string& name) override;

  /// True if saved work was found: the journal has records.
  [[nodiscard]] bool resumes() const { return resumes_; }
  /// Makes the folder stay, for a later run to go on from.
  void keep() { keep_ = true; }
  /// Makes the folder go, since the run is done.
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

/// Returns the text of a small file of a run.  A damaged file may have any size, so at most 16 MiB
/// are read, or one byte more than the text that is expected, if that is more.
[[nodiscard]] std::string settings_in(const std::filesystem::path& file,
                                      std::string_view expected = {});

/// Returns the value of a setting saved in a folder, or nothing where the folder does not name it.
[[nodiscard]] std::optional<std::string> saved_value(const std::filesystem::path& path,
                                                     const std::string& name);

/// True if the settings saved in a folder are exactly these.
[[nodiscard]] bool is_identity_of(const std::filesystem::path& path, const std::string& settings);

/// Returns "--window was 32 and is 64; ..." for lines "name = value" that differ, with "--" where
/// the name is that of a setting; empty if none does. Where results_id() differs, which is the
/// value of "results", it says that and nothing else.
[[nodiscard]] std::string differences(const std::string& before, const std::string& now);

/// Returns the line "first voxel = X,Y,Z", which says where in the file the volume begins.
[[nodiscard]] std::string first_voxel_text(const io::VolumeInfo& volume);

/// Returns differences() between shape, origin and first voxel of the volume and those that the
/// settings in a folder name; empty where these do not name all.
[[nodiscard]] std::string place_differences(const std::filesystem::path& path,
                                            const io::VolumeInfo& volume);

/// Returns the space with the spacing, axes and origin that the settings in a folder name, where
/// these are its own up to a millionth of a voxel's edge, as when another program has saved a file
/// again; else the space as it is.
[[nodiscard]] io::VolumeSpace settled_space(const std::filesystem::path& path,
                                            const io::VolumeSpace& space);

/// Returns a line "name = value" for shape, type and space of the volume and for each entry of
/// setting_table().  The caller adds what it knows of the program and the labels (StoreOptions):
/// mwmesh adds its version and results_id(), and a fingerprint of the labels after --crop, --merge
/// and --drop-specks.
///
/// It leaves out what does not change the tets of the work folder: which labels are written, how,
/// with which names and nodes; threads, memory and how often work is saved.  It also leaves out the
/// program that triangulates for Optimizer::kTetgen, which is built with this one and has its
/// version; a user who names another one (MW_CODT_WORKER) for a resumed run gets tets of both.
[[nodiscard]] std::string identity_text(const io::VolumeInfo& volume, const MeshSettings& settings);

}  // namespace mw::engine
