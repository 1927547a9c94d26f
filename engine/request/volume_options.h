// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Options about the input volume, shared by all subcommands that read one.
#pragma once

#include <filesystem>

#include "engine/request/option_set.h"
#include "io/labels/prepared_input.h"
#include "io/volume/open_options.h"

namespace mw::request {

/// What the user said about a volume.
struct VolumeRequest {
  std::filesystem::path path;
  io::OpenOptions open;         ///< all but `raw`, for which the next three are
  std::optional<Index3> shape;  ///< says that the file is raw
  std::optional<io::VoxelType> type;
  std::optional<io::ByteOrder> order;
  io::InputSteps steps;         ///< what is done with the labels that were opened
  std::filesystem::path names;  ///< file with names of labels; if empty, the volume has them
};

/// Adds the argument INPUT.
void add_input_option(OptionSet& options, std::filesystem::path& path);

/// Adds --spacing --origin --frame; --shape --dtype for raw files; --dataset --scale for files of
/// several arrays; --overlap; --values; --crop; --object; --cache.
void add_volume_options(OptionSet& options, VolumeRequest& request);

/// Adds --merge --drop-specks --interpolate-slices --weld, which are done with the labels before
/// all else (io::PreparedInput), and --names, which tells what they are called.
void add_step_options(OptionSet& options, VolumeRequest& request);

/// Returns the formats of volumes, for the end of the help.
[[nodiscard]] std::string volume_note();

/// ERRORS: mw::Error(kUsage) when values contradict each other.
[[nodiscard]] io::OpenOptions open_options(const VolumeRequest& request);

/// Throws for --cache as a flag where the volume is on a disk, so that nothing would be kept.  A
/// variable or a config file may name the folder for whatever volumes are remote.
/// ERRORS: mw::Error(kUsage) naming the volume.
void refuse_idle_cache(const OptionSet& options, const VolumeRequest& request);

/// Opens the volume of the request with the names of its labels; its steps are left to
/// io::PreparedInput.  warn is told what was taken for what files leave open.
[[nodiscard]] std::unique_ptr<io::LabelVolume> open(
    const VolumeRequest& request, const std::function<void(const std::string&)>& warn);

/// Returns the names of the labels of the request's volume.
[[nodiscard]] io::LabelNames names_of(const VolumeRequest& request);

/// Returns the bytes of its file that a chunked volume may keep while nothing but labels is read.
[[nodiscard]] std::uint64_t cache_bytes(std::uint64_t memory);

}  // namespace mw::request
