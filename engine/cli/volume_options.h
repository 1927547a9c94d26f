// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Options about the input volume, shared by all subcommands that read one.
#pragma once

#include <filesystem>

#include "engine/cli/option_set.h"
#include "io/volume/open_options.h"

namespace mw::cli {

/// What the user said about a volume.
struct VolumeRequest {
  std::filesystem::path path;
  std::optional<std::array<double, 3>> spacing;
  std::optional<std::array<double, 3>> origin;
  std::optional<Index3> shape;
  std::optional<io::VoxelType> type;
  std::optional<io::ByteOrder> order;
  std::filesystem::path names;  ///< of labels; empty: only those in the volume's file
};

/// Positional INPUT.
void add_input_option(OptionSet& options, std::filesystem::path& path);

/// --spacing --origin --names, and --shape --dtype --endian --dataset for files that need them.
void add_volume_options(OptionSet& options, VolumeRequest& request);

/// ERRORS: mw::Error(kUsage) when the path is missing or values contradict each other.
[[nodiscard]] io::OpenOptions open_options(const VolumeRequest& request);

/// open_volume of the request, and the names of its labels.
[[nodiscard]] std::unique_ptr<io::LabelVolume> open(const VolumeRequest& request);

/// ERRORS: mw::Error(kUsage) naming the option when the path is empty.
void require_path(const std::filesystem::path& path, const char* name);

}  // namespace mw::cli
