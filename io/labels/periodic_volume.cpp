// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "io/labels/periodic_volume.h"

#include <vector>

#include "kernels/core/assert.h"
#include "kernels/core/index.h"

namespace mw::io {
namespace {

/// Returns a / b rounded down.
std::int64_t quotient(std::int64_t a, std::int64_t b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

/// Returns the copies of a cell that a box meets; copy c begins at c * shape.
Box3 copies_over(const Box3& box, Index3 shape) {
  const Index3 last = box.hi - Index3{1, 1, 1};
  return {{quotient(box.lo.x, shape.x), quotient(box.lo.y, shape.y), quotient(box.lo.z, shape.z)},
          {quotient(last.x, shape.x) + 1, quotient(last.y, shape.y) + 1,
           quotient(last.z, shape.z) + 1}};
}

}  // namespace

PeriodicVolume::PeriodicVolume(const LabelVolume& volume, Index3 margin)
    : VolumeView(volume), margin_(margin), info_(volume.info()) {
  info_.shape = info_.shape + margin + margin;
  const Vector3 first =
      to_world(info_.space, {-static_cast<double>(margin.x), -static_cast<double>(margin.y),
                             -static_cast<double>(margin.z)});
  info_.space.origin = first;
}

void PeriodicVolume::read(const Box3& box, std::span<RawLabel> out) const {
  MW_ASSERT(out.size() == static_cast<std::size_t>(box.voxels()));
  if (out.empty()) return;
  const Index3 shape = below().info().shape;
  const Box3 wanted{box.lo - margin_, box.hi - margin_};
  std::vector<RawLabel> labels;
  for_each_index(copies_over(wanted, shape), [&](Index3 copy) {
    const Index3 first{copy.x * shape.x, copy.y * shape.y, copy.z * shape.z};
    const Box3 part = intersection(wanted, {first, first + shape});
    labels.resize(static_cast<std::size_t>(part.voxels()));
    below().read({part.lo - first, part.hi - first}, labels);
    std::size_t next = 0;
    for_each_index(
        part, [&](Index3 v) { out[static_cast<std::size_t>(wanted.offset(v))] = labels[next++]; });
  });
}

}  // namespace mw::io
