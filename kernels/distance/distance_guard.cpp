// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where samples go when interface triangles change, and whether they may.
#include "kernels/distance/distance_guard.h"

#include <algorithm>

namespace mw {
namespace {

constexpr double kRoundingGuard = 1e-9;

Vec3 in_voxels(Point p) {
  return Vec3(p.x, p.y, p.z) / static_cast<double>(kUnitsPerVoxel);
}

}  // namespace

DistanceGuard::DistanceGuard(const LabelBox& labels, double max_distance, CarriedSamples& samples)
    : reach_(labels, max_distance),
      placing_distance_(max_distance - kSampleCoveringRadius - kRoundingGuard),
      samples_(samples) {}

void DistanceGuard::add_changed(const TetMesh& mesh, LocalVertex v, LocalVertex other,
                                LocalVertex survivor, Point target) {
  fan_.collect(mesh, v, triangles_);
  const bool same_place = v == survivor && target == mesh.position(v);
  for (const FanTriangle& t : triangles_) {
    const bool vanishes = t.a == other || t.b == other;
    // The triangles at both ends vanish once.
    if (vanishes && v != survivor) continue;
    changed_.push_back({.before = triangle_key(v, t.a, t.b),
                        .after = triangle_key(survivor, t.a, t.b),
                        .shape = DistanceTriangle({in_voxels(target), in_voxels(mesh.position(t.a)),
                                                   in_voxels(mesh.position(t.b))}),
                        .low = t.low,
                        .high = t.high,
                        .vanishes = vanishes,
                        .stays = same_place && !vanishes});
  }
}

bool DistanceGuard::allows_contraction(const TetMesh& mesh, LocalVertex keep, LocalVertex drop,
                                       Point target) {
  changed_.clear();
  add_changed(mesh, keep, drop, keep, target);
  add_changed(mesh, drop, keep, keep, target);
  return keeps_bound();
}

bool DistanceGuard::allows_move(const TetMesh& mesh, LocalVertex v, Point target) {
  changed_.clear();
  add_changed(mesh, v, mesh.infinity(), v, target);
  return keeps_bound();
}

bool DistanceGuard::allows_flip(const TetMesh& mesh, const std::array<LocalVertex, 2>& pq,
                                const std::array<LocalVertex, 2>& ab, Label low, Label high) {
  changed_.clear();
  for (LocalVertex a : ab) {
    const TriangleKey old = triangle_key(pq[0], pq[1], a);
    changed_.push_back({.before = old,
                        .after = old,
                        .shape = DistanceTriangle({Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}),
                        .low = low,
                        .high = high,
                        .vanishes = true});
  }
  for (LocalVertex p : pq) {
    const TriangleKey fresh = triangle_key(ab[0], ab[1], p);
    changed_.push_back(
        {.before = fresh,
         .after = fresh,
         .shape = DistanceTriangle({in_voxels(mesh.position(p)), in_voxels(mesh.position(ab[0])),
                                    in_voxels(mesh.position(ab[1]))}),
         .low = low,
         .high = high});
  }
  return keeps_bound();
}

/// Samples first: a triangle out of reach is bisected to the end before it is refused, and the
/// other order takes 12 % more time on an abdomen CT.
bool DistanceGuard::keeps_bound() {
  handovers_.clear();
  for (std::size_t i = 0; i < changed_.size(); ++i) {
    if (!changed_[i].stays && !place_samples(i)) return false;
  }
  return std::all_of(changed_.begin(), changed_.end(), [this](const Changed& t) {
    return t.stays || t.vanishes || reach_.within(t.shape.corners(), t.low, t.high);
  });
}

bool DistanceGuard::place_samples(std::size_t from) {
  return samples_.each(changed_[from].before, [&](FaceSamples s) { return place(s, from); });
}

/// Together when the centre of the face is so near that all of them are, else one by one.
bool DistanceGuard::place(FaceSamples samples, std::size_t from) {
  const double for_centre = placing_distance_ - kSampleCoveringRadius;
  if (const auto to = receiver(in_voxels(face_centre(samples)), from, for_centre)) {
    handovers_.push_back({*to, samples});
    return true;
  }
  for (unsigned quarter = 0; quarter < kSamplesPerFace; ++quarter) {
    const QuarterBits bit = 1U << quarter;
    if ((quarters_of(samples) & bit) == 0) continue;
    const auto to = receiver(in_voxels(sample_position(samples, quarter)), from, placing_distance_);
    if (!to) return false;
    handovers_.push_back({*to, with_quarters(samples, bit)});
  }
  return true;
}

/// The triangle that takes p over: what becomes of its present one, else the nearest; none when
/// that is farther than limit.
std::optional<std::size_t> DistanceGuard::receiver(const Vec3& p, std::size_t from,
                                                   double limit) const {
  if (limit < 0.0) return std::nullopt;
  const Changed& old = changed_[from];
  double nearest = limit * limit;
  if (!old.vanishes && old.shape.squared_distance(p) <= nearest) return from;
  std::optional<std::size_t> to;
  for (std::size_t i = 0; i < changed_.size(); ++i) {
    const Changed& t = changed_[i];
    if (t.vanishes || t.low != old.low || t.high != old.high) continue;
    const double d = t.shape.squared_distance(p);
    if (to ? d < nearest : d <= nearest) {
      nearest = d;
      to = i;
    }
  }
  return to;
}

void DistanceGuard::commit() {
  for (const Changed& t : changed_) {
    if (!t.stays) samples_.erase(t.before);
  }
  for (const Handover& h : handovers_) {
    const Changed& t = changed_[h.to];
    samples_.add(t.after, t.low, h.samples);
  }
}

}  // namespace mw
