// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a caller may say about a volume beyond its file.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/byte_order.h"
#include "io/remote/disk_cache.h"
#include "io/volume/label_volume.h"
#include "io/volume/volume_readers.h"

namespace mw::io {

/// A raw file has no header: shape (x, y, z), type and byte order come from the caller.
struct RawLayout {
  Index3 shape;
  VoxelType type = VoxelType::kU8;
  ByteOrder order = ByteOrder::kLittle;
};

/// The world frame of coordinates.
enum class FrameChoice {
  kFile,   ///< the file's own
  kRas,    ///< see WorldFrame
  kLps,    ///< see WorldFrame
  kVoxel,  ///< the array's axes: spacing * corner, the first corner at 0
};

/// Which of the two places that a NIfTI file may have.
enum class FormChoice {
  kFile,   ///< the sform, else the qform
  kSform,  ///< the sform alone
  kQform,  ///< the qform alone
};

/// Returns the choice called "sform" or "qform", and nothing for other names.
[[nodiscard]] inline std::optional<FormChoice> parse_form_choice(std::string_view name) {
  if (name == "sform") return FormChoice::kSform;
  if (name == "qform") return FormChoice::kQform;
  return std::nullopt;
}

/// What becomes of a voxel that is in several masks.
enum class Overlap {
  kRefused,  ///< an error
  kFirst,    ///< the label of the first of them
  kLast,     ///< the label of the last of them
  kAll,      ///< a label that each such set of masks has for itself
};

/// Returns kFirst for "first" and so on, and nothing for other names.
[[nodiscard]] inline std::optional<Overlap> parse_overlap(std::string_view name) {
  if (name == "first") return Overlap::kFirst;
  if (name == "last") return Overlap::kLast;
  if (name == "all") return Overlap::kAll;
  return std::nullopt;
}

/// What the numbers in a file are.
enum class VoxelValues {
  kLabels,
  kProbabilities,  ///< one number a voxel for each class; see io/volume/scores/open_scores.h
  kDistances,      ///< one signed distance a voxel for each label, negative inside
};

/// Returns kLabels for "labels" and so on, and nothing for other names.
[[nodiscard]] inline std::optional<VoxelValues> parse_voxel_values(std::string_view name) {
  if (name == "labels") return VoxelValues::kLabels;
  if (name == "probabilities") return VoxelValues::kProbabilities;
  if (name == "distances") return VoxelValues::kDistances;
  return std::nullopt;
}

struct OpenOptions {
  std::optional<RawLayout> raw;                  ///< read as raw, whatever the content
  std::optional<std::array<double, 3>> spacing;  ///< instead of the file's, which is not looked at
  std::optional<std::array<double, 3>> origin;   ///< instead of the file's, which is not looked at
  FrameChoice frame = FrameChoice::kFile;
  FormChoice form = FormChoice::kFile;  ///< of NIfTI files
  /// The array within a file or store that may hold several.  Empty: conventions choose it.
  std::string dataset;
  std::optional<int> scale;             ///< resolution level, 0 the finest; empty: the finest
  Overlap overlap = Overlap::kRefused;  ///< what masks that overlap become
  VoxelValues values = VoxelValues::kLabels;
  std::optional<Box3> crop;  ///< part of the volume, voxels as the data set counts them
  /// The only labels that matter: all others become 0, and the volume ends around these
  /// (open_object()), within `crop`.  Where there are none, all labels matter.
  std::vector<RawLabel> object;
  std::optional<CacheFolder> cache;  ///< for what servers send; see remote_place()
  /// Whether files that headers and metadata name may be anywhere, not only in their folder.
  bool trust_paths = false;
  std::uint64_t cache_bytes = 64ULL << 20U;  ///< bytes of decoded chunks that may be kept
  /// How `object` is looked for where reading waits for a network, within as many bytes again as
  /// may be kept.
  VisitAtOnce at_once = visit_in_turn;
};

}  // namespace mw::io
