// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A link that shows a folder of precomputed meshes in neuroglancer.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace mw::cli {

/// What a view of a folder shows.
struct FolderView {
  std::string name;
  std::array<double, 3> low{}, high{};  ///< the box around all meshes, in nm
  std::vector<std::string> segments;    ///< the largest ones, and of these the largest first
};

/// Reads what `mwmesh surface` wrote about its meshes.
/// ERRORS: mw::Error(kInput) saying how such a folder is made where this one is none.
[[nodiscard]] FolderView read_folder_view(const std::filesystem::path& folder);

/// Returns the link to a view of the folder, which is served at `address`; viewer is the address of
/// neuroglancer.
[[nodiscard]] std::string view_link(const FolderView& view, const std::string& address,
                                    const std::string& viewer);

}  // namespace mw::cli
