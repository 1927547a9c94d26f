// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/job/halving.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/labels/voxel_lattice.h"
#include "io/file/errors.h"
#include "kernels/core/error.h"

namespace mw::engine {

int halvings_of(const io::VolumeInfo& volume, const MeshJob& job, double in_image) {
  const SizeSettings& sizes = job.settings.sizes;
  if (!sizes.rules.any() || sizes.count > 0) return 0;
  const double kept = least_size(volume), listed = sizes.rules.least();
  if (std::ldexp(listed, io::kMostHalvings) < kept) {
    throw Error(ErrorKind::kUsage,
                io::text("size ", listed,
                         " is too small: the marches make edges as long as the diagonals of "
                         "voxels, and tets are cut ",
                         io::kMostHalvings, " times at most; ",
                         told_size(std::ldexp(kept, -io::kMostHalvings)), " can be kept"));
  }
  const double least = std::min(listed, in_image);
  int times = 0;
  while (times < io::kMostHalvings && std::ldexp(least, times) < kept) ++times;
  const bool is_alone = job.run.processes == nullptr || job.run.processes->count() == 1;
  if (times == 0 || is_alone) return times;
  throw Error(ErrorKind::kUsage, io::text("size ", least, ": sizes below ", told_size(kept),
                                          " are for one process only, run mwmesh without mpirun"));
}

SizeSettings before_halvings(SizeSettings sizes, int times) {
  const int edges = 1 << times;  // into which an edge is cut, one behind the other
  sizes.rules = sizes.rules.scaled(edges);
  sizes.across = (sizes.across + edges - 1) / edges;
  return sizes;
}

Halving::Halving(int times, io::MeshSink& below, const MeshJob& job, const io::LabelTable& table,
                 std::vector<double> sizes)
    : below_(below), table_(table), stop_(job.stop) {
  if (times > 0 && job.is_measured) quality_.emplace();
  if (times > 0 && !sizes.empty()) edges_.emplace(table.size(), std::move(sizes));
  for (int i = 0; i < times; ++i) {
    const auto see_last = [this](const auto& corners, RawLabel label) { see(corners, label); };
    cuts_.push_back(std::make_unique<io::HalvedSink>(sink(), job.folder.empty() ? "." : job.folder,
                                                     i == 0 ? io::SeeTet(see_last) : nullptr));
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
