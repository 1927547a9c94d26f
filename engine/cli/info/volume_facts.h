// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What `mwmesh info` prints about a volume.
#pragma once

#include <vector>

#include "engine/cli/requests.h"
#include "engine/labels/label_regions.h"
#include "io/json/json.h"

namespace mw::cli {

/// A volume and its labels, which are read once; remote ones only with --scale or --crop.
class VolumeFacts {
 public:
  /// ERRORS: those of open() and of reading the volume.
  explicit VolumeFacts(const VolumeRequest& request);

  /// Returns all facts except a row for each label.
  [[nodiscard]] const io::Json& json() const { return facts_; }
  [[nodiscard]] std::size_t labels() const { return regions_.size(); }
  /// Returns label, name, voxels, box (hi is one behind the last voxel), volume and colour of the
  /// i-th label, ascending.  REQUIRES: i < labels().
  [[nodiscard]] io::Json label_row(std::size_t i) const;

 private:
  io::VolumeInfo info_;
  std::vector<engine::LabelRegion> regions_;
  io::Json facts_;
};

/// Prints the facts as text on stdout, with a table of the first 1,000 labels.
void print_volume(const VolumeFacts& volume);
/// Prints all facts as JSON on stdout, with the rows of labels.  Memory: one row at a time.
void print_volume_json(const VolumeFacts& volume);

}  // namespace mw::cli
