// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sums over voxels between two neighbours.
#include "engine/labels/texture_volume.h"

#include <algorithm>

namespace mw::engine {
namespace {

/// Returns a - b, where a is the larger number of the two, or the largest step that is told from
/// others, so that no sum overflows.  The difference of 64-bit labels is exact in unsigned numbers,
/// whether they are signed or not.
std::uint64_t step(RawLabel a, RawLabel b) {
  constexpr std::uint64_t kLargest = 1 << 20;
  return std::min(a - b, kLargest);
}

/// Orders labels as numbers.
bool is_above(RawLabel a, RawLabel b, bool is_signed) {
  return is_signed ? static_cast<std::int64_t>(a) > static_cast<std::int64_t>(b) : a > b;
}

}  // namespace

void TextureVolume::read(const Box3& box, std::span<RawLabel> out) const {
  below().read(box, out);
  const auto row = static_cast<std::size_t>(box.shape().x);
  if (row < 3) return;
  for (std::size_t at = 0; at < out.size(); at += row) look_at(out.subspan(at, row));
}

void TextureVolume::look_at(std::span<const RawLabel> row) const {
  const bool is_signed = io::has_signed_labels(info());
  std::uint64_t singles = 0, ends = 0, peaks = 0, steps = 0;
  bool before = row[0] != row[1];
  for (std::size_t i = 1; i + 1 < row.size(); ++i) {
    const RawLabel a = row[i - 1], b = row[i], c = row[i + 1];
    const bool after = b != c;
    ends += before != after ? 1U : 0U;
    if (before && after) {
      ++singles;
      const bool is_top = is_above(b, a, is_signed);
      if (is_top == is_above(b, c, is_signed)) {
        ++peaks;
        steps += is_top ? step(b, a) + step(b, c) : step(a, b) + step(c, b);
      }
    }
    before = after;
  }
  singles_ += singles;
  ends_ += ends;
  peaks_ += peaks;
  steps_ += steps;
}

bool TextureVolume::is_image(const io::LabelTable& table) const {
  constexpr std::size_t kLeastValues = 16;
  constexpr double kLargestStep = 0.2;
  const std::size_t values = table.size();
  if (values < kLeastValues || singles_ <= ends_ || peaks_ < 2 * values) return false;
  return static_cast<double>(steps_) <
         kLargestStep * static_cast<double>(values) * 2 * static_cast<double>(peaks_);
}

}  // namespace mw::engine
