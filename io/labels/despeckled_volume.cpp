// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Finds the specks, settles them, and lays their new labels over what is read.
#include "io/labels/despeckled_volume.h"

#include <algorithm>
#include <utility>

#include "io/labels/specks.h"
#include "kernels/core/assert.h"

namespace mw::io {

DespeckledVolume::DespeckledVolume(const LabelVolume& volume, const SpeckRule& rule,
                                   const SpeckLimits& limits)
    : VolumeView(volume) {
  Specks specks = find_specks(volume, rule, limits);
  SpeckOutcome outcome;
  if (!specks.runs.empty()) {
    outcome = settle_specks(specks.labels, find_contacts(volume, rule, specks, limits),
                            has_signed_labels(volume.info()));
  }
  std::erase_if(specks.runs, [&](const SpeckRun& run) { return !outcome.becomes[run.speck]; });
  runs_ = std::move(specks.runs);
  runs_.shrink_to_fit();
  facts_.rounds = outcome.rounds;
  for (const auto& label : outcome.becomes) {
    becomes_.push_back(label.value_or(0));
    if (label) ++facts_.components;
  }
  for (const SpeckRun& run : runs_) {
    facts_.voxels += static_cast<std::uint64_t>(run.end - run.begin);
  }
  find_planes();
}

void DespeckledVolume::find_planes() {
  plane_begin_.assign(static_cast<std::size_t>(info().shape.z) + 1, 0);
  for (const SpeckRun& run : runs_) ++plane_begin_[static_cast<std::size_t>(run.z) + 1];
  for (std::size_t z = 1; z < plane_begin_.size(); ++z) plane_begin_[z] += plane_begin_[z - 1];
}

std::uint64_t DespeckledVolume::held_bytes() const {
  return runs_.capacity() * sizeof(SpeckRun) + becomes_.capacity() * sizeof(RawLabel) +
         plane_begin_.size() * sizeof(std::size_t);
}

void DespeckledVolume::read(const Box3& box, std::span<RawLabel> out) const {
  MW_ASSERT(out.size() == static_cast<std::size_t>(box.voxels()));
  below().read(box, out);
  const auto row = static_cast<std::size_t>(box.shape().x);
  for (std::int64_t z = box.lo.z; z < box.hi.z; ++z) {
    const auto at = static_cast<std::size_t>(z);
    if (plane_begin_[at] == plane_begin_[at + 1]) continue;
    for (std::int64_t y = box.lo.y; y < box.hi.y; ++y) {
      const Index3 first{box.lo.x, y, z};
      change_row(first, out.subspan(static_cast<std::size_t>(box.offset(first)), row));
    }
  }
}

void DespeckledVolume::change_row(Index3 first, std::span<RawLabel> row) const {
  const auto at = static_cast<std::size_t>(first.z);
  const std::span plane =
      std::span(runs_).subspan(plane_begin_[at], plane_begin_[at + 1] - plane_begin_[at]);
  const std::int64_t end = first.x + static_cast<std::int64_t>(row.size());
  auto run = std::partition_point(plane.begin(), plane.end(), [&](const SpeckRun& r) {
    return std::pair<std::int64_t, std::int64_t>(r.y, r.end) <= std::pair(first.y, first.x);
  });
  for (; run != plane.end() && run->y == first.y && run->begin < end; ++run) {
    const std::int64_t lo = std::max<std::int64_t>(run->begin, first.x);
    const std::int64_t hi = std::min<std::int64_t>(run->end, end);
    std::fill_n(row.begin() + (lo - first.x), hi - lo, becomes_[run->speck]);
  }
}

}  // namespace mw::io
