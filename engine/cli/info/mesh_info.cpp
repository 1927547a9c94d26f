// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sums over tets and facets of a grouped mesh, and a mesh and its volume side by side.
#include "engine/cli/info/mesh_info.h"
#include "engine/cli/log.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>

#include "engine/labels/label_regions.h"
#include "engine/labels/label_scan.h"
#include "engine/labels/reading_tiles.h"
#include "kernels/audit/compensated_sum.h"
#include "kernels/audit/regions/regions.h"
#include "kernels/audit/shape/quality.h"
#include "kernels/core/vector3.h"

namespace mw::cli {

VolumeSide look_at_volume(const VolumeRequest& request, bool with_areas) {
  const std::unique_ptr<io::LabelVolume> opened = open(request, log_warning);
  engine::SharedReads shared(*opened);
  const io::PreparedInput input(shared, request.steps);
  shared.end();
  const io::VolumeInfo& info = input.volume().info();
  VolumeSide out{.voxels = {}, .unit = info.space.unit, .names = info.names, .areas = {}};
  for (const engine::LabelRegion& region :
       engine::label_regions(input.volume(), engine::thread_count(0))) {
    out.voxels.emplace(region.label, region.voxels);
  }
  const auto& edge = info.space.spacing;
  for (const double length : edge) out.voxel_volume *= length;
  if (!with_areas) return out;
  constexpr auto kMuch = std::numeric_limits<std::uint64_t>::max();
  const int readers = engine::scanner_count(input.volume(), 1, kMuch);
  for (const engine::LabelContact& c : engine::label_contacts(input.volume(), readers)) {
    double area = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      area += static_cast<double>(c.faces[k]) * edge[(k + 1) % 3] * edge[(k + 2) % 3];
    }
    out.areas[{c.first, c.second}] = area;
  }
  return out;
}

namespace {

using io::Position;

double area_of(const Position& a, const Position& b, const Position& c) {
  return norm(cross(minus(b, a), minus(c, a))) / 2;
}

/// Sums over the tets of one label.
class LabelSums {
 public:
  void add(const std::array<Position, 4>& corners) {
    const auto& [a, b, c, d] = corners;
    if (tets_ == 0) lo_ = hi_ = first_ = a;
    const double volume = std::abs(dot(cross(minus(b, a), minus(c, a)), minus(d, a))) / 6;
    volume_.add(volume);
    const double ratio = audit::radius_ratio(a, b, c, d);
    min_ = tets_ == 0 ? ratio : std::min(min_, ratio);
    ratios_.add(ratio);
    ++tets_;
    for (std::size_t k = 0; k < 3; ++k) {
      // Moments are relative to a corner, so that far from the origin nothing is lost.
      moment_[k].add(
          volume *
          ((a[k] - first_[k]) + (b[k] - first_[k]) + (c[k] - first_[k]) + (d[k] - first_[k])) / 4);
      for (const Position& p : corners) {
        lo_[k] = std::min(lo_[k], p[k]);
        hi_[k] = std::max(hi_[k], p[k]);
      }
    }
  }

  [[nodiscard]] LabelStats stats() const {
    LabelStats out{.tets = tets_, .volume = volume_.value(), .radius_ratio_min = min_};
    out.radius_ratio_mean = ratios_.value() / static_cast<double>(tets_);
    out.lo = lo_;
    out.hi = hi_;
    for (std::size_t k = 0; k < 3; ++k) {
      const double shift = out.volume > 0 ? moment_[k].value() / out.volume : 0;
      out.centroid[k] = first_[k] + shift;
    }
    return out;
  }

 private:
  std::uint64_t tets_ = 0;
  audit::CompensatedSum volume_;
  audit::CompensatedSum ratios_;
  double min_ = 0;
  Position first_{};
  Position lo_{};
  Position hi_{};
  std::array<audit::CompensatedSum, 3> moment_;
};

void measure_tets(io::GroupedMesh& mesh, MeshStats& stats) {
  for (const io::RowRange& range : mesh.label_tets()) {
    LabelSums sums;
    for (std::uint64_t t = range.begin; t < range.end; ++t) {
      const io::TetRows tet = mesh.tet(t);
      sums.add({mesh.node(tet[0]), mesh.node(tet[1]), mesh.node(tet[2]), mesh.node(tet[3])});
    }
    stats.labels.push_back(sums.stats());
  }
}

double group_area(io::GroupedMesh& mesh, const io::RowRange& facets) {
  audit::CompensatedSum area;
  for (std::uint64_t f = facets.begin; f < facets.end; ++f) {
    const auto [a, b, c] = mesh.facet(f).rows;
    area.add(area_of(mesh.node(a), mesh.node(b), mesh.node(c)));
  }
  return area.value();
}

void measure_facets(io::GroupedMesh& mesh, MeshStats& stats) {
  for (const io::FacetGroup& group : mesh.facet_groups()) {
    const double area = group_area(mesh, group.facets);
    stats.labels[group.first].area += area;
    if (group.side == io::Side::kInterface) {
      stats.labels[group.second].area += area;
      stats.contacts.push_back({group.first, group.second, group.facets.size(), area});
    } else if (group.side != io::Side::kOuter) {
      stats.labels[group.first].area_on_box += area;
    }
  }
}

void measure_masks(const io::GroupedMesh& mesh, MeshStats& stats) {
  for (const io::MaskGroup& mask : io::mask_groups(mesh)) {
    MaskStats sums{.mask = mask};
    for (const Label rank : sums.mask.ranks) {
      sums.tets += stats.labels[rank].tets;
      sums.volume += stats.labels[rank].volume;
    }
    stats.masks.push_back(std::move(sums));
  }
}

/// Returns whether all tets together are the whole box, so that nothing was left out.
bool fills_box(const io::GroupedMesh& mesh) {
  return std::ranges::none_of(mesh.facet_groups(), [](const io::FacetGroup& group) {
    return group.side == io::Side::kOuter;
  });
}

void measure_betti(io::GroupedMesh& mesh, MeshStats& stats) {
  std::vector<audit::Position> vertices;
  std::vector<audit::TetRow> tets;
  std::vector<Label> labels;
  for (std::uint64_t v = 0; v < mesh.vertex_count(); ++v) vertices.push_back(mesh.node(v));
  for (std::uint64_t t = 0; t < mesh.tet_count(); ++t) {
    tets.push_back(mesh.tet(t));
    labels.push_back(mesh.label_of(t));
  }
  const bool is_whole = fills_box(mesh);
  const auto betti_of = [&](std::span<const Label> of_tets, std::size_t count) {
    const audit::AuditMesh view{vertices, tets, of_tets};
    return is_whole ? audit::mesh_betti(view, count) : audit::region_betti(view, count);
  };
  const std::vector<audit::RegionBetti> betti = betti_of(labels, stats.labels.size());
  for (std::size_t rank = 0; rank < stats.labels.size(); ++rank) {
    stats.labels[rank].betti = betti[rank];
  }
  for (MaskStats& mask : stats.masks) {
    std::vector<Label> in_mask;
    in_mask.reserve(labels.size());
    for (const Label label : labels) {
      in_mask.push_back(std::ranges::binary_search(mask.mask.ranks, label) ? 0 : 1);
    }
    mask.betti = betti_of(in_mask, 2).front();
  }
}

}  // namespace

MeshStats measure_mesh(io::GroupedMesh& mesh, bool count_betti) {
  MeshStats stats;
  measure_tets(mesh, stats);
  measure_facets(mesh, stats);
  measure_masks(mesh, stats);
  if (count_betti) measure_betti(mesh, stats);
  return stats;
}

}  // namespace mw::cli
