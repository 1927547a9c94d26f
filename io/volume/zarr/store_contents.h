// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which volumes a Zarr store holds.
#pragma once

#include <string>
#include <vector>

#include "io/volume/zarr/zarr_node.h"

namespace mw::io {

/// Paths, below the group, of arrays and of multiscale images (whose levels are not named): sorted,
/// the first 100, at most 5 groups deep.
/// ERRORS: mw::Error(kInput) when metadata on the way are damaged.
[[nodiscard]] std::vector<std::string> volumes_below(const std::filesystem::path& group);

/// The labels of a multiscale image, as --dataset wants them: "labels/cells".  Damaged metadata of
/// theirs are none.
[[nodiscard]] std::vector<std::string> labels_of_image(const std::filesystem::path& group);

/// "a, b, c", and "..." behind the first 20.
[[nodiscard]] std::string listed(const std::vector<std::string>& names);

}  // namespace mw::io
