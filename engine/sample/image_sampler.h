// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Values of tets from images beside the labels.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/system/crew.h"
#include "io/mesh/mesh_sink.h"
#include "io/volume/label_volume.h"
#include "io/volume/number_volume.h"

namespace mw::engine {

enum class Statistic {
  kMean,  ///< weighted by volume
  kMin,
  kMax,
  kMode,  ///< the value with the largest volume, the smaller of two equals
};

/// An image of any grid, from which each tet gets a number.
struct SampleImage {
  std::string name;
  std::string file;       ///< what errors call the image
  std::string dataset{};  ///< the data set in a file that holds several
  Statistic statistic = Statistic::kMean;
  std::shared_ptr<const io::LabelVolume> image{};  ///< set when it is opened
};

/// What was found for the tets that were written.
struct SampleFacts {
  std::string name;
  std::string file;
  Statistic statistic = Statistic::kMean;
  double least = 0;  ///< the least value of a tet
  double most = 0;   ///< the largest value of a tet
  std::uint64_t tets = 0;
  std::uint64_t partly_outside = 0;
  std::uint64_t outside = 0;  ///< tets without a value
};

/// Cuts tets by the voxels of images, tile by tile, so that an image of any size takes the memory
/// of a tile.  A voxel that is no finite number is outside of the image.  Only the part of a tet
/// inside counts; a tet of which less than a millionth is inside has no value.
/// For kMin and kMax a voxel counts if a millionth of the tet, or of the voxel, is in both.
/// Thread safety: none; it has threads of its own.
class ImageSampler {
 public:
  /// labels describes the volume that is meshed, and so the world that positions are in.
  /// ERRORS: mw::Error(kUsage) when an image has other units of length.
  ImageSampler(std::vector<SampleImage> images, const io::VolumeInfo& labels, int threads);

  /// Returns the names of the images.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  /// Returns a number that tets share whose middles lie in one tile of the first image.
  [[nodiscard]] std::uint64_t cell_of(const std::array<io::Position, 4>& corners) const;
  /// Returns how many tets of() may be asked for at once.
  [[nodiscard]] std::size_t most_tets() const;
  /// Returns a row for each tet and a column for each name; NaN stands for unknown.  tets are rows
  /// of `positions`.
  /// ENSURES: the values of a tet depend on its corners alone.
  /// ERRORS: those of the images; kInput when a tet has too many values of an image for kMode.
  [[nodiscard]] std::vector<double> of(std::span<const io::Position> positions,
                                       std::span<const io::TetRows> tets);
  /// Returns the most bytes that it holds from the first tet to the last.
  [[nodiscard]] std::uint64_t buffer_bytes() const;
  [[nodiscard]] std::vector<SampleFacts> facts() const { return facts_; }

 private:
  class Sampling;

  std::vector<SampleImage> images_;
  std::vector<std::string> names_;
  std::vector<io::VolumeSpace> spaces_;  ///< spaces of the images in the world of the labels
  std::vector<SampleFacts> facts_;
  int threads_;
  std::optional<Crew> crew_;
};

}  // namespace mw::engine
