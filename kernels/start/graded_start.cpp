// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tets, vertices and samples of the leaves of a block.
#include "kernels/start/graded_start.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "kernels/core/error.h"
#include "kernels/core/index.h"
#include "kernels/start/carrier_faces.h"
#include "kernels/start/cells/cell_template.h"
#include "kernels/start/corner_quadric.h"
#include "kernels/start/surface_nodes.h"

namespace mw {
namespace {

/// A triangle by voxel corners.
using CornerTriangle = std::array<Index3, 3>;

CornerTriangle placed(const Cell& cell, const NodeTriangle& t) {
  return {position_of(cell, t[0]), position_of(cell, t[1]), position_of(cell, t[2])};
}

Point lattice_point(Index3 corner) {
  return {static_cast<std::int32_t>(corner.x * kUnitsPerVoxel),
          static_cast<std::int32_t>(corner.y * kUnitsPerVoxel),
          static_cast<std::int32_t>(corner.z * kUnitsPerVoxel)};
}

/// True if point p is on the triangle, seen along the axis; decided in whole lattice units.
bool on_triangle(Point p, const CornerTriangle& t, unsigned axis) {
  const auto flat = [axis](Point q) {
    return axis == 0   ? std::array<std::int64_t, 2>{q.y, q.z}
           : axis == 1 ? std::array<std::int64_t, 2>{q.x, q.z}
                       : std::array<std::int64_t, 2>{q.x, q.y};
  };
  int left = 0, right = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto a = flat(lattice_point(t[i])), b = flat(lattice_point(t[(i + 1) % 3])), c = flat(p);
    const std::int64_t turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    left += turn > 0 ? 1 : 0;
    right += turn < 0 ? 1 : 0;
  }
  return left == 0 || right == 0;
}

/// The point of a voxel face nearest to p, one unit off its rim: triangles beside the face, between
/// other labels, may touch the rim.  (Sample points lie at quarters of a voxel, so the triangle
/// that holds this point holds the nearest one as well.)
Point nearest_on(const VoxelFace& face, Point p) {
  const Point lo = lattice_point(face.lower), hi = lattice_point(face.upper() + Index3{1, 1, 1});
  // `hi` is one voxel too far along the face's axis; there only its lower side, `upper`, counts.
  const Point upper = lattice_point(face.upper());
  const auto within = [&face](unsigned axis, std::int32_t v, std::int32_t from, std::int32_t to,
                              std::int32_t plane) {
    return axis == face.axis ? plane : std::clamp(v, from + 1, to - 1);
  };
  return {within(0, p.x, lo.x, hi.x, upper.x), within(1, p.y, lo.y, hi.y, upper.y),
          within(2, p.z, lo.z, hi.z, upper.z)};
}

class StartBuilder {
 public:
  StartBuilder(const StartLabels& labels, const LevelMap& large, const Box3& block, Index3 volume,
               const StartOptions& options)
      : labels_(labels),
        block_(block),
        corners_{block.lo, block.hi + Index3{1, 1, 1}},
        volume_(volume),
        options_(options),
        carriers_(options.max_distance),
        levels_(labels.shape, volume, {block.lo - Index3{1, 1, 1}, block.hi + Index3{1, 1, 1}},
                options.max_level, large, options.sizes),
        surface_(levels_, labels.shape, volume, options.sizes),
        own_templates_(options.metric, options.quality_floor),
        templates_(options.templates != nullptr ? *options.templates : own_templates_),
        used_(static_cast<std::size_t>(corners_.voxels()), 0),
        known_(static_cast<std::size_t>(block.voxels()), nullptr) {
    templates_.make_room();
  }

  BlockMesh build() {
    add_cells();
    if (options_.with_samples) {
      each_input_face([&](const VoxelFace& face) { add_samples(face); });
    }
    number_vertices();
    std::sort(mesh_.tets.begin(), mesh_.tets.end());
    std::sort(mesh_.samples.begin(), mesh_.samples.end());
    return std::move(mesh_);
  }

  StartSize size() {
    add_cells();
    StartSize out;
    out.vertices = static_cast<std::uint64_t>(std::count(used_.begin(), used_.end(), 1));
    out.tets = mesh_.tets.size();
    if (options_.with_samples) {
      each_input_face([&](const VoxelFace& face) {
        if (index_in_block(face)) out.samples += kSamplesPerFace;
      });
    }
    return out;
  }

 private:
  /// Marks a corner as used.  Returns its position among all corners of the block, which ascends
  /// with the id but is not yet a row.
  std::uint32_t position(Index3 corner) {
    const std::int64_t at = corners_.offset(corner);
    used_[static_cast<std::size_t>(at)] = 1;
    return static_cast<std::uint32_t>(at);
  }

  void add_cells() {
    const Box3 pairs{{block_.lo.x / 2, block_.lo.y / 2, block_.lo.z / 2},
                     {(block_.hi.x + 1) / 2, (block_.hi.y + 1) / 2, (block_.hi.z + 1) / 2}};
    for_each_index(pairs, [&](Index3 p) {
      const Index3 voxel{2 * p.x, 2 * p.y, 2 * p.z};
      const Cell cell{voxel, levels_.level_at(voxel)};
      if (is_single(cell)) return add_voxels(voxel);
      if (cell.level == 0) return add_mixed({voxel, 1});
      const std::int64_t mask = cell.size() - 1;
      if (((voxel.x | voxel.y | voxel.z) & mask) == 0) add_cell(cell);
    });
  }

  /// True for leaves of one voxel that make tets of their own: all of the paper's start mesh, and
  /// those without partners.
  [[nodiscard]] bool is_single(const Cell& leaf) const {
    return leaf.level == 0 && (options_.max_level == 0 || surface_.is_clipped(leaf.lo));
  }

  /// REQUIRES: the cell is in the block.
  const CellTemplate& template_of(const Cell& cell) {
    const CellTemplate*& known = known_[static_cast<std::size_t>(block_.offset(cell.lo))];
    if (known == nullptr) known = &templates_.of(surface_.of(cell), is_odd(cell));
    return *known;
  }

  void add_tet(const Cell& cell, const NodeTet& t, Label label) {
    std::array<std::uint32_t, 4> positions{};
    for (std::size_t i = 0; i < 4; ++i) positions[i] = position(position_of(cell, t[i]));
    std::sort(positions.begin(), positions.end());
    mesh_.tets.push_back({positions, label});
  }

  /// Adds those of the eight voxels from `lo` on that are in the block.
  void add_voxels(Index3 lo) {
    for_each_index(Box3{lo, lo + Index3{2, 2, 2}}, [&](Index3 voxel) {
      if (block_.contains(voxel)) add_cell({voxel, 0});
    });
  }

  void add_cell(const Cell& cell) {
    const Label label = labels_.shape.at(cell.lo);
    for (const NodeTet& t : template_of(cell).tets) add_tet(cell, t, label);
  }

  /// Adds a mixed cell.  Each of its eight voxels is the union of the cones from the cell's centre
  /// to the voxel's outer faces.
  void add_mixed(const Cell& cell) {
    for (const NodeTriangle& t : template_of(cell).surface) {
      add_tet(cell, {kCellCentre, t[0], t[1], t[2]}, labels_.shape.at(voxel_behind(cell, t)));
    }
  }

  /// Returns a voxel of a mixed cell that is behind a triangle of its surface.  Where several are,
  /// they have the same label.
  static Index3 voxel_behind(const Cell& cell, const NodeTriangle& t) {
    const auto upper = [&t](unsigned axis) {
      return node_along(t[0], axis) + node_along(t[1], axis) + node_along(t[2], axis) > 3 ? 1 : 0;
    };
    return cell.lo + Index3{upper(0), upper(1), upper(2)};
  }

  /// Calls visit(face) on all input faces that this block's triangles may carry.
  template <typename Visit>
  void each_input_face(Visit visit) const {
    const std::vector<Label>& all = labels_.original.labels;
    if (std::all_of(all.begin(), all.end(), [&](Label l) { return l == all[0]; })) return;
    const std::int64_t reach = options_.coarse ? 1 : 0;
    const Index3 lo = block_.lo - Index3{reach + 1, reach + 1, reach + 1};
    for_each_index(Box3{lo, block_.hi + Index3{reach, reach, reach}}, [&](Index3 lower) {
      const Label label = labels_.original.at(lower);
      if (label == kExterior) return;
      for (unsigned axis = 0; axis < 3; ++axis) {
        const Label beyond = labels_.original.at(lower + axis_vector(axis));
        if (beyond != label && beyond != kExterior) visit(VoxelFace{lower, axis});
      }
    });
  }

  /// Where an input face's samples go, if they go to triangles of this block.
  struct Place {
    VoxelFace carrier;
    Index3 owner;  ///< the voxel on the smaller label's side
    Label label = 0;
  };

  [[nodiscard]] std::optional<Place> index_in_block(const VoxelFace& face) const {
    const LabelPair pair = labels_beside(labels_.original, face);
    const VoxelFace carrier = carrier_of(face);
    const bool low_is_lower = labels_.shape.at(carrier.lower) == pair.low;
    const Index3 owner = low_is_lower ? carrier.lower : carrier.upper();
    if (!block_.contains(owner)) return std::nullopt;
    return Place{carrier, owner, pair.low};
  }

  void add_samples(const VoxelFace& face) {
    const std::optional<Place> position = index_in_block(face);
    if (!position) return;
    triangulate(position->owner,
                {position->carrier.axis, position->owner == position->carrier.lower});
    const FaceSamples all = face_samples(face.lower, face.axis, kAllQuarters);
    const std::size_t first = mesh_.samples.size();
    for (unsigned quarter = 0; quarter < kSamplesPerFace; ++quarter) {
      const Point p = sample_position(all, quarter);
      add_to_face({triangle_below(p, position->carrier), position->label,
                   with_quarters(all, 1U << quarter)},
                  first);
    }
  }

  /// Puts the triangles of the start mesh around a face of a voxel into triangles_: those of the
  /// face of its cell, or those in the middle of its mixed cell.
  void triangulate(Index3 voxel, CellFace face) {
    const Cell cell = cell_at(voxel);
    triangles_.clear();
    const bool outer =
        along(voxel, face.axis) == along(cell.lo, face.axis) + (face.high ? cell.size() - 1 : 0);
    if (!outer) return triangulate_middle(cell, face.axis);
    for (const NodeTriangle& t : template_of(cell).on(face)) {
      triangles_.push_back(placed(cell, t));
    }
  }

  /// The leaf at a voxel, or the mixed cell.
  [[nodiscard]] Cell cell_at(Index3 voxel) const {
    const int leaf = levels_.level_at(voxel);
    const int level = leaf == 0 && !is_single({voxel, 0}) ? 1 : leaf;
    const auto floor = [level](std::int64_t v) { return v >> level << level; };
    return {{floor(voxel.x), floor(voxel.y), floor(voxel.z)}, level};
  }

  /// Triangles across an axis between the centre of a mixed cell and the edges on its surface.
  void triangulate_middle(const Cell& cell, unsigned axis) {
    for (const NodeTriangle& t : template_of(cell).surface) {
      for (std::size_t i = 0; i < 3; ++i) {
        const CellNode a = t[i], b = t[(i + 1) % 3];
        if (node_along(a, axis) != 1 || node_along(b, axis) != 1) continue;
        triangles_.push_back(placed(cell, {kCellCentre, a, b}));
      }
    }
  }

  [[nodiscard]] VoxelFace carrier_of(const VoxelFace& face) const {
    for (const VoxelFace& c : carriers_.of(face.axis)) {
      const VoxelFace carrier{face.lower + c.lower, c.axis};
      if (may_carry(labels_.shape, carrier, labels_.original, face)) return carrier;
    }
    throw Error(ErrorKind::kInternal, "coarsening left an interface face without a carrier");
  }

  /// Corners, ascending, of that one of triangles_ that holds the carrier's point nearest to p.
  std::array<std::uint32_t, 3> triangle_below(Point p, const VoxelFace& carrier) {
    const Point foot = nearest_on(carrier, p);
    const auto found =
        std::find_if(triangles_.begin(), triangles_.end(),
                     [&](const CornerTriangle& t) { return on_triangle(foot, t, carrier.axis); });
    MW_ASSERT(found != triangles_.end());
    std::array<std::uint32_t, 3> positions{position((*found)[0]), position((*found)[1]),
                                           position((*found)[2])};
    std::sort(positions.begin(), positions.end());
    return positions;
  }

  /// Joins a sample to those of its face on the same triangle; its face's rows begin at `first`.
  void add_to_face(const BlockSample& one, std::size_t first) {
    for (std::size_t i = first; i < mesh_.samples.size(); ++i) {
      if (mesh_.samples[i].triangle != one.triangle) continue;
      mesh_.samples[i].samples |= one.samples;
      return;
    }
    mesh_.samples.push_back(one);
  }

  /// Turns positions into rows and lists the vertices.
  void number_vertices() {
    std::vector<std::uint32_t> row(used_.size());
    std::size_t at = 0;
    for_each_index(corners_, [&](Index3 corner) {
      if (used_[at] != 0) {
        row[at] = static_cast<std::uint32_t>(mesh_.vertices.size());
        const auto id = static_cast<VertexId>(
            (corner.z * (volume_.y + 1) + corner.y) * (volume_.x + 1) + corner.x);
        mesh_.vertices.push_back({id, lattice_point(corner), quadric_of(corner)});
      }
      ++at;
    });
    for (BlockTet& t : mesh_.tets) {
      for (std::uint32_t& v : t.vertices) v = row[v];
    }
    for (BlockSample& s : mesh_.samples) {
      for (std::uint32_t& v : s.triangle) v = row[v];
    }
  }

  [[nodiscard]] Quadric quadric_of(Index3 corner) const {
    return options_.coarse ? wide_quadric(labels_, corner, options_)
                           : corner_quadric(labels_.original, corner, options_.weights);
  }

  StartLabels labels_;
  Box3 block_;
  Box3 corners_;
  Index3 volume_;
  StartOptions options_;
  CarrierFaces carriers_;
  CellLevels levels_;
  SurfaceNodes surface_;
  CellTemplates own_templates_;
  CellTemplates& templates_;
  std::vector<std::uint8_t> used_;
  std::vector<const CellTemplate*> known_;  ///< by a cell's lowest voxel; null until asked for
  std::vector<CornerTriangle> triangles_;
  BlockMesh mesh_;
};

}  // namespace

BlockMesh graded_start(const StartLabels& labels, const LevelMap& levels, const Box3& block,
                       Index3 volume, const StartOptions& options) {
  return StartBuilder(labels, levels, block, volume, options).build();
}

StartSize graded_start_size(const StartLabels& labels, const LevelMap& levels, const Box3& block,
                            Index3 volume, const StartOptions& options) {
  return StartBuilder(labels, levels, block, volume, options).size();
}

}  // namespace mw
