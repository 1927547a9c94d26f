// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Finds the highest score voxel by voxel.
#include "io/volume/scores/open_scores.h"

#include <algorithm>
#include <cmath>

#include "io/file/errors.h"
#include "kernels/core/assert.h"
#include "kernels/core/mix_bits.h"

namespace mw::io {
namespace {

/// The most voxels whose scores are held at once.
constexpr std::int64_t kMostVoxels = 1 << 17;
/// What a voxel takes: the highest score so far, the next one, and its bits while it is read.
constexpr std::uint64_t kBytesPerVoxel = 3 * sizeof(double);

/// Splits a box across its slowest axis of more than one voxel until its parts are small.
template <typename Visit>
void each_small_part(const Box3& box, Visit visit) {
  const Index3 n = box.shape();
  if (box.voxels() <= kMostVoxels) return visit(box);
  Box3 low = box, high = box;
  if (n.z > 1) {
    low.hi.z = high.lo.z = box.lo.z + n.z / 2;
  } else if (n.y > 1) {
    low.hi.y = high.lo.y = box.lo.y + n.y / 2;
  } else {
    low.hi.x = high.lo.x = box.lo.x + n.x / 2;
  }
  each_small_part(low, visit);
  each_small_part(high, visit);
}

/// Whether a number is from 0 to 1, up to what filters and resampling leave beyond.
bool is_probability(double number) {
  constexpr double kBeyond = 1e-3;
  return number >= -kBeyond && number <= 1 + kBeyond;
}

double ground_score(VoxelValues values) {
  constexpr double kHalf = 0.5;
  return values == VoxelValues::kDistances ? 0.0 : kHalf;
}

}  // namespace

ScoredLabels::ScoredLabels(std::vector<ScoreComponent> components, VoxelValues values,
                           LabelNames names)
    : components_(std::move(components)),
      values_(values),
      has_ground_(has_ground(components_.size(), values)),
      info_(components_.front().volume->info()) {
  constexpr std::size_t kLabelsOfByte = 256;
  info_.type = labels() <= kLabelsOfByte ? VoxelType::kU8 : VoxelType::kU16;
  info_.scaled = false;
  info_.format += values == VoxelValues::kDistances ? " distances" : " probabilities";
  info_.names = std::move(names);
  for (const ScoreComponent& c : components_) info_.numbering = mix_text(c.name, info_.numbering);
}

void ScoredLabels::read_scores(RawLabel label, const Box3& box, std::span<double> out) const {
  if (has_ground_ && label == 0) {
    std::fill(out.begin(), out.end(), ground_score(values_));
    return;
  }
  dynamic_cast<const NumberVolume&>(*component_of(label).volume).read_numbers(box, out);
  if (values_ != VoxelValues::kDistances) return;
  for (double& score : out) score = -score;
}

void ScoredLabels::check_numbers(RawLabel label, const Box3& box,
                                 std::span<const double> scores) const {
  const bool may_be_any = values_ == VoxelValues::kDistances;
  const auto bad = std::find_if(scores.begin(), scores.end(), [&](double s) {
    return std::isnan(s) || !(may_be_any || is_probability(s));
  });
  if (bad == scores.end()) return;
  const std::int64_t at = bad - scores.begin();
  const Index3 n = box.shape();
  const Index3 v = box.lo + Index3{at % n.x, at / n.x % n.y, at / (n.x * n.y)};
  const std::string where = text("voxel (", v.x, ", ", v.y, ", ", v.z, ")");
  if (std::isnan(*bad)) {
    fail_input(component_of(label).name, where, "the value is not a number (NaN)",
               "write a number for each voxel, 0 for a probability that is unknown");
  }
  fail_input(component_of(label).name, where,
             text("the value ", *bad, " is no probability, which is from 0 to 1"),
             "divide percents by 100 and bytes by 255, take the softmax or sigmoid of scores, or "
             "give --values distances for signed distances (negative inside)");
}

void ScoredLabels::read_part(const Box3& part, const Box3& box, std::span<RawLabel> out) const {
  std::vector<double> best(static_cast<std::size_t>(part.voxels())), next(best.size());
  std::vector<RawLabel> found(best.size());
  read_scores(0, part, best);
  if (!has_ground_) check_numbers(0, part, best);
  for (RawLabel label = 1; label < labels(); ++label) {
    read_scores(label, part, next);
    check_numbers(label, part, next);
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (!(next[i] > best[i])) continue;
      best[i] = next[i];
      found[i] = label;
    }
  }
  std::size_t i = 0;
  for_each_index(part,
                 [&](Index3 v) { out[static_cast<std::size_t>(box.offset(v))] = found[i++]; });
}

void ScoredLabels::read(const Box3& box, std::span<RawLabel> out) const {
  MW_ASSERT(out.size() == static_cast<std::size_t>(box.voxels()));
  if (is_empty(box)) return;
  each_small_part(box, [&](const Box3& part) { read_part(part, box, out); });
}

std::uint64_t ScoredLabels::buffer_bytes(int threads) const {
  std::uint64_t out =
      static_cast<std::uint64_t>(threads) * kMostVoxels * (kBytesPerVoxel + sizeof(RawLabel));
  for (const ScoreComponent& c : components_) out += c.volume->buffer_bytes(threads);
  return out;
}

void ScoredLabels::drop_buffers() const {
  for (const ScoreComponent& c : components_) c.volume->drop_buffers();
}

}  // namespace mw::io
