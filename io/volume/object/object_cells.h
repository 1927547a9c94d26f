// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where in a volume an object is: the cells that have voxels of its labels.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "io/volume/label_volume.h"
#include "io/volume/volume_readers.h"

namespace mw::io {

/// Labels of an object, ascending.
using ObjectLabels = std::vector<RawLabel>;
/// Returns the labels as "1, 2, 3", for messages.  One with the highest bit is told as both numbers
/// that a user may have given for it.
[[nodiscard]] std::string listed(const ObjectLabels& labels);

/// Cells of a volume; cell c has the voxels from c * size on.
class ObjectCells {
 public:
  /// REQUIRES: size positive along each axis.
  ObjectCells(Index3 shape, Index3 size);

  [[nodiscard]] Index3 size() const { return size_; }
  /// The voxels of a cell that are in the volume.
  [[nodiscard]] Box3 voxels(Index3 cell) const;
  /// The cells that a box of voxels meets.  REQUIRES: box.lo not negative.
  [[nodiscard]] Box3 met_by(const Box3& box) const { return cells_of(box, size_); }

  [[nodiscard]] bool has(Index3 cell) const { return cells_.contains(key(cell)); }
  void add(Index3 cell) { cells_.insert(key(cell)); }
  [[nodiscard]] std::size_t count() const { return cells_.size(); }
  /// Takes the first cell out, in raster order.  REQUIRES: count() > 0.
  Index3 take_first();

 private:
  [[nodiscard]] std::uint64_t key(Index3 cell) const;

  Index3 shape_;
  Index3 size_;
  std::set<std::uint64_t> cells_;
};

/// An object in a volume.
struct FoundObject {
  ObjectCells cells;  ///< those that have voxels of it
  Box3 box;           ///< the box around its voxels
};

/// Returns the size of cells that are worth reading: that of the volume's chunks where it is handy.
[[nodiscard]] Index3 cell_size(const VolumeInfo& info);

/// How cells are read: `count` of them at once.  What is found does not depend on it.
struct CellReaders {
  int count = 1;
  VisitAtOnce at_once = visit_in_turn;
};
/// Returns how many cells of a volume are read at once: several where reading waits for a network,
/// as far as they fit into `memory` bytes (readers_that_fit()).
[[nodiscard]] int cell_readers(const LabelVolume& volume, std::uint64_t memory);

/// Follows an object from some cells on, through all voxels of its labels that touch each other by
/// a face, an edge or a corner.  What touches none of the seeds' voxels is not found, and nothing
/// outside of `bounds` is looked at.
/// Cost: reads each cell of the object once, and each cell that the object touches.
/// ERRORS: mw::Error(kInput) naming a label of which no voxel was found; what reading throws.
[[nodiscard]] FoundObject follow_object(const LabelVolume& volume, const ObjectLabels& labels,
                                        ObjectCells seeds, const Box3& bounds,
                                        const CellReaders& readers = {});

/// What scan_for_object() looks for.
struct ObjectScan {
  Index3 shape;  ///< of the volume
  const ObjectLabels& labels;
  Box3 bounds;  ///< the voxels of the volume that are looked at
};

/// Looks for labels in a coarser copy of a volume.  For each voxel of the copy that has one, calls
/// visit(box) with the box of it and one more voxel of the copy around it, in no particular order,
/// one after the other.  Boxes are in voxels of the volume.  Returns the labels that were seen,
/// ascending.
ObjectLabels scan_for_object(const LabelVolume& copy, const ObjectScan& scan,
                             const std::function<void(const Box3&)>& visit,
                             const CellReaders& readers = {});

/// Returns the voxels of a copy of the volume that scan_for_object() looks at.
[[nodiscard]] Box3 bounds_in_copy(const VolumeInfo& copy, Index3 shape, const Box3& bounds);

}  // namespace mw::io
