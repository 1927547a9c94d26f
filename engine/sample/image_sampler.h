// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What images beside the labels say of each tet.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/output/cell_values.h"
#include "engine/system/crew.h"
#include "io/volume/label_volume.h"
#include "io/volume/number_volume.h"

namespace mw::engine {

enum class Statistic {
  kMean,  ///< weighted by volume
  kMin,
  kMax,
  kMode,  ///< the value of most of the volume, the smaller of two
};

/// Numbers for each tet from an image of any grid.
struct SampleImage {
  std::string name;
  std::string file;       ///< what errors call the image
  std::string dataset{};  ///< within a file that holds several
  Statistic statistic = Statistic::kMean;
  std::shared_ptr<const io::LabelVolume> image{};  ///< once it is opened
};

/// What was found for all tets that were written.
struct SampleFacts {
  std::string name;
  std::string file;
  Statistic statistic = Statistic::kMean;
  double least = 0;  ///< of tets with a value, as the next
  double most = 0;
  std::uint64_t tets = 0;
  std::uint64_t partly_outside = 0;
  std::uint64_t outside = 0;  ///< without a value
};

/// Cuts tets by the voxels of images, tile by tile, so that an image of any size takes the memory
/// of a tile.  A voxel that is no finite number is outside of the image.  Of a tet that is partly
/// outside the part inside counts, if that is a millionth of the tet or more; else it has no value.
/// For kMin and kMax a voxel counts if a millionth of the tet, or of the voxel, is in both.
/// Thread safety: none; it has threads of its own.
class ImageSampler : public CellValues {
 public:
  /// labels: of the volume that is meshed, which tells the world that positions are in.
  /// ERRORS: mw::Error(kUsage) when an image lies in a world that has nothing to do with it: other
  ///         units.
  ImageSampler(std::vector<SampleImage> images, const io::VolumeInfo& labels, int threads);

  [[nodiscard]] const std::vector<std::string>& names() const override { return names_; }
  /// ERRORS: those of the images; kInput when too many values of an image are in one tet to find
  /// that of the most.
  [[nodiscard]] std::vector<double> of(std::span<const io::Position> positions,
                                       std::span<const io::TetRows> tets,
                                       const HoldMemory& hold) override;
  [[nodiscard]] std::uint64_t buffer_bytes() const override;
  [[nodiscard]] std::vector<SampleFacts> facts() const { return facts_; }

 private:
  class Sampling;

  std::vector<SampleImage> images_;
  std::vector<std::string> names_;
  std::vector<io::VolumeSpace> spaces_;  ///< of the images, in the world of the labels
  std::vector<SampleFacts> facts_;
  int threads_;
  std::optional<Crew> crew_;
};

}  // namespace mw::engine
