// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/job/halving.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/labels/voxel_lattice.h"
#include "io/file/errors.h"
#include "kernels/distance/distance_guard.h"

namespace mw::engine {
namespace {

/// The share of the bound on the distance that the marches keep to where tets are cut afterwards.
constexpr double kMarchesShare = 0.8;

/// Returns how interfaces move; each of the cuts may use its part of what the marches left.
std::optional<io::HalvedCurves> curves_of(int times, const MeshSettings& asked,
                                          const io::DenseVolume& volume) {
  if (times == 0 || asked.surface != Surface::kSmooth) return std::nullopt;
  io::HalvedCurves out{.most_move = std::numeric_limits<double>::infinity(),
                       .max_distance = asked.max_distance};
  if (asked.max_distance) {
    const auto voxel = VoxelLattice(volume).info().space.spacing;
    const double left = *asked.max_distance - *before_halvings(asked, times).max_distance;
    out.most_move = left / times * *std::min_element(voxel.begin(), voxel.end());
  }
  return out;
}

}  // namespace

int halvings_of(const io::VolumeInfo& volume, const MeshJob& job, double in_image) {
  const SizeSettings& sizes = job.settings.sizes;
  if (!sizes.rules.any() || sizes.count > 0) return 0;
  const double kept = least_size(volume), listed = sizes.rules.least();
  if (std::ldexp(listed, io::kMostHalvings) < kept) {
    io::fail_usage("size ", listed,
                   " is too small: the marches make edges as long as the diagonals of "
                   "voxels, and tets are cut ",
                   io::kMostHalvings, " times at most; ",
                   told_size(std::ldexp(kept, -io::kMostHalvings)), " can be kept");
  }
  const double least = std::min(listed, in_image);
  int times = 0;
  while (times < io::kMostHalvings && std::ldexp(least, times) < kept) ++times;
  const bool is_alone = job.run.processes == nullptr || job.run.processes->count() == 1;
  if (times == 0 || is_alone) return times;
  io::fail_usage("size ", least, ": sizes below ", told_size(kept),
                 " are for one process only, run mwmesh without mpirun");
}

MeshSettings before_halvings(MeshSettings settings, int times) {
  if (times == 0) return settings;
  const int edges = 1 << times;  // into which an edge is cut, one behind the other
  settings.sizes.rules = settings.sizes.rules.scaled(edges);
  settings.sizes.across = (settings.sizes.across + edges - 1) / edges;
  if (settings.surface == Surface::kSmooth && settings.max_distance) {
    settings.max_distance =
        std::min(*settings.max_distance,
                 std::max(DistanceGuard::min_distance(), kMarchesShare * *settings.max_distance));
  }
  return settings;
}

Halving::Halving(int times, io::MeshSink& below, const MeshJob& job, const io::DenseVolume& volume,
                 std::vector<double> sizes)
    : below_(below), table_(volume.table()), stop_(job.stop) {
  if (times > 0 && job.is_measured) quality_.emplace();
  if (times > 0 && !sizes.empty()) edges_.emplace(table_.size(), std::move(sizes));
  const std::optional<io::HalvedCurves> curves = curves_of(times, job.settings, volume);
  for (int i = 0; i < times; ++i) {
    const auto see_last = [this](const auto& corners, RawLabel label) { see(corners, label); };
    cuts_.push_back(std::make_unique<io::HalvedSink>(sink(), job.folder.empty() ? "." : job.folder,
                                                     i == 0 ? io::SeeTet(see_last) : nullptr,
                                                     curves));
  }
}

void Halving::see(const std::array<io::Position, 4>& corners, RawLabel label) {
  constexpr std::uint64_t kTetsBetween = 4096;
  if (tets_ % kTetsBetween == 0) stop_();
  if (quality_) quality_->add(tets_, corners);
  if (edges_) edges_->add(table_.dense(label), corners);
  ++tets_;
}

void Halving::report(RunReport& out) {
  out.halvings = static_cast<int>(cuts_.size());
  if (cuts_.empty()) return;
  out.vertices = cuts_.front()->mesh().node_count();
  out.tets = tets_;
  if (quality_) out.quality = quality_->report();
  if (!edges_) return;
  out.longest_edges = edges_->lengths();
  out.edge_ratios = edges_->ratios();
}

}  // namespace mw::engine
