// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the work of a run depends on, as lines of text, and how it differs from that of another run.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "engine/settings/settings.h"
#include "io/volume/label_volume.h"

namespace mw::engine {

inline constexpr const char* kSettingsFile = "settings.txt";

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
