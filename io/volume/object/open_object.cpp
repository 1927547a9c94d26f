// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Looks for an object from the coarsest copy of a volume to the finest, and reads a volume that
// shows it, cell by cell.
#include "io/volume/object/open_object.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "io/file/errors.h"
#include "kernels/core/sort_distinct.h"

namespace mw::io {
namespace {

[[noreturn]] void fail_not_found(const std::string& name, const ObjectLabels& wanted,
                                 const ObjectLabels& seen, const std::string& way_out) {
  ObjectLabels missing;
  std::set_difference(wanted.begin(), wanted.end(), seen.begin(), seen.end(),
                      std::back_inserter(missing));
  fail_input(name, "--object", text("no voxel has ", listed(missing)), way_out);
}

class SeedSearch {
 public:
  SeedSearch(const ScaledVolume& scaled, const ObjectLabels& labels, const Box3& bounds)
      : scaled_(scaled), labels_(labels), bounds_(bounds) {}

  /// Returns the cells of the volume around what a copy, or the volume itself, shows of the labels.
  ObjectCells find() {
    std::unique_ptr<LabelVolume> finer = open_copy(0);
    for (int copy = 0; copy < scaled_.copies; ++copy) {
      const std::unique_ptr<LabelVolume> current = std::exchange(finer, open_copy(copy + 1));
      if (voxels_of(finer ? *finer : *scaled_.volume) <= scaled_.cheap_voxels) continue;
      if (look_through(*current)) return std::move(*seeds_);
    }
    if (look_through(*scaled_.volume)) return std::move(*seeds_);
    fail_not_found(scaled_.name, labels_, seen_, "`mwmesh info` lists the labels of a volume");
  }

 private:
  [[nodiscard]] std::unique_ptr<LabelVolume> open_copy(int copy) const {
    return copy < scaled_.copies ? scaled_.open_copy(copy) : nullptr;
  }
  /// Returns how many voxels of a copy are looked at.
  [[nodiscard]] std::uint64_t voxels_of(const LabelVolume& copy) const {
    const Index3 shape = scaled_.volume->info().shape;
    return static_cast<std::uint64_t>(bounds_in_copy(copy.info(), shape, bounds_).voxels());
  }
  bool look_through(const LabelVolume& copy) {
    const Index3 shape = scaled_.volume->info().shape;
    if (voxels_of(copy) > kMostScannedVoxels) {
      fail_not_found(scaled_.name, labels_, seen_,
                     text("in scales of up to ", kMostScannedVoxels,
                          " voxels; give --crop around the object"));
    }
    ObjectCells& seeds = seeds_.emplace(shape, cell_size(scaled_.volume->info()));
    seen_ = scan_for_object(copy, {shape, labels_, bounds_},
                            [&](const Box3& around) {
                              for_each_index(seeds.met_by(around),
                                             [&](Index3 cell) { seeds.add(cell); });
                            },
                            {cell_readers(copy, scaled_.memory), scaled_.at_once});
    return seen_ == labels_;
  }

  const ScaledVolume& scaled_;
  const ObjectLabels& labels_;
  Box3 bounds_;
  ObjectLabels seen_;
  std::optional<ObjectCells> seeds_;
};

}  // namespace

ObjectView open_object(ScaledVolume scaled, ObjectLabels labels, const Box3& bounds) {
  sort_distinct(labels);
  if (std::binary_search(labels.begin(), labels.end(), kNotTheObject)) {
    fail_usage("--object: label ", kNotTheObject, " stands for all that is not the object");
  }
  ObjectCells seeds = SeedSearch(scaled, labels, bounds).find();
  FoundObject found = follow_object(*scaled.volume, labels, std::move(seeds), bounds,
                                    {cell_readers(*scaled.volume, scaled.memory), scaled.at_once});
  const Box3 box = intersection(grown(found.box, kObjectMargin), bounds);
  scaled.volume->drop_buffers();
  return {std::make_unique<ObjectVolume>(std::move(scaled.volume), std::move(labels),
                                         std::move(found.cells)),
          box};
}

ObjectVolume::ObjectVolume(std::unique_ptr<LabelVolume> volume, ObjectLabels labels,
                           ObjectCells cells)
    : VolumeView(std::move(volume)), labels_(std::move(labels)), cells_(std::move(cells)) {}

void ObjectVolume::read(const Box3& box, std::span<RawLabel> out) const {
  std::fill(out.begin(), out.end(), kNotTheObject);
  std::vector<RawLabel> voxels;
  for_each_index(cells_.met_by(box), [&](Index3 cell) {
    if (!cells_.has(cell)) return;
    const Box3 part = intersection(cells_.voxels(cell), box);
    voxels.resize(static_cast<std::size_t>(part.voxels()));
    below().read(part, voxels);
    std::size_t at = 0;
    for_each_index(part, [&](Index3 v) {
      const RawLabel label = voxels[at++];
      if (!std::binary_search(labels_.begin(), labels_.end(), label)) return;
      out[static_cast<std::size_t>(box.offset(v))] = label;
    });
  });
}

}  // namespace mw::io
