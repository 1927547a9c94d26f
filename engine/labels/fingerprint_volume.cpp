// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The fingerprint of a volume, summed as it is read.
#include "engine/labels/label_counts.h"

#include <array>
#include <cstdio>

#include "engine/labels/reading_tiles.h"
#include "engine/system/crew.h"
#include "kernels/core/index.h"

namespace mw::engine {
namespace {

/// The finaliser of SplitMix64 (Steele, Lea and Flood, OOPSLA 2014): every bit reaches every bit.
std::uint64_t mixed(std::uint64_t v) {
  v = (v ^ v >> 30) * 0xBF58476D1CE4E5B9ULL;
  v = (v ^ v >> 27) * 0x94D049BB133111EBULL;
  return v ^ v >> 31;
}

std::uint64_t sum_over(const Box3& box, std::span<const RawLabel> labels, Index3 volume) {
  const Box3 all{{0, 0, 0}, volume};
  std::uint64_t sum = 0;
  std::size_t next = 0;
  for_each_index(box, [&](Index3 voxel) {
    const auto position = static_cast<std::uint64_t>(all.offset(voxel));
    sum += mixed(mixed(labels[next++] + 1) + position);
  });
  return sum;
}

}  // namespace

void FingerprintVolume::read(const Box3& box, std::span<RawLabel> out) const {
  below().read(box, out);
  sum_ += sum_over(box, out, info().shape);
}

std::uint64_t FingerprintVolume::of(const Box3& box) const {
  std::vector<RawLabel> labels(static_cast<std::size_t>(box.voxels()));
  below().read(box, labels);
  return sum_over(box, labels, info().shape);
}

std::string FingerprintVolume::text() const {
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx",
                static_cast<unsigned long long>(sum_.load()));
  return digits.data();
}

}  // namespace mw::engine
