// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How a cell is cut into tets, which follows from the nodes on its surface, and the worst of them.
#pragma once

#include <array>
#include <span>
#include <unordered_map>
#include <vector>

#include "kernels/core/metric.h"
#include "kernels/start/cells/cell.h"

namespace mw {

using NodeTriangle = std::array<CellNode, 3>;
using NodeTet = std::array<CellNode, 4>;

/// Cuts a face with the given nodes into triangles, whose orientation is not defined.
///
/// A face with a node in its middle is a fan from there.  From other faces, corners between two
/// middles of edges are cut off first.  The rest is a fan from the lowest middle of an edge that is
/// the only one or has one across the face; from the far corner, when the only two middles are on
/// neighbouring edges; or, without middles, two triangles joined along the diagonal of the face's
/// even corners: those of even coordinate sum, counted in cells (Sec 5.1).  odd is is_odd().
/// ENSURES: the cell on the other side of the face finds the same triangles.
[[nodiscard]] std::vector<NodeTriangle> face_triangles(CellNodes nodes, bool odd, CellFace face);

struct CellTemplate {
  /// face_triangles() of all faces, one face after the other.
  std::vector<NodeTriangle> surface;
  std::array<std::size_t, 6> ends{};  ///< where each face's triangles end
  /// The tets of a cell of one label; their orientation is not defined.
  std::vector<NodeTet> tets;

  /// Triangles of one face.
  [[nodiscard]] std::span<const NodeTriangle> on(CellFace face) const;
};

/// Cuts a cell of one label.
///
/// A cell without hanging nodes is cut into the five tets of Sec 5.1.  In others all triangles of
/// the surface are joined to an apex.  Candidates are the nodes of the surface at which all
/// triangles of their own faces meet; the one with the best worst radius ratio (the lowest of
/// equals) is the apex if that ratio is at least the larger of 0.25 and the quality floor, or at
/// least what the centre gives.  Otherwise the centre is the apex.  An apex on the surface spares a
/// vertex, and with it a contraction, in 97 of 100 such cells of dense EM.
[[nodiscard]] CellTemplate cut_cell(CellNodes nodes, bool odd, const Metric& metric,
                                    double quality_floor = 0.0);

/// Returns the worst radius ratio of a cell's tets.  Where one is below `enough`, later groups of
/// four are not looked at.
[[nodiscard]] double worst_ratio(std::span<const NodeTet> tets, const Metric& metric,
                                 double enough = 0.0);

/// Templates, each made once.  Memory: 2 KiB for each.  Thread safety: none.
class CellTemplates {
 public:
  static constexpr std::size_t kMost = 512;

  explicit CellTemplates(const Metric& metric, double quality_floor = 0.0)
      : metric_(metric), quality_floor_(quality_floor) {}

  /// Returns a template, which is there until make_room().
  [[nodiscard]] const CellTemplate& of(CellNodes nodes, bool odd);
  /// Forgets all templates where they are more than kMost.
  void make_room() {
    if (known_.size() > kMost) known_.clear();
  }

  [[nodiscard]] std::size_t size() const { return known_.size(); }

 private:
  Metric metric_;
  double quality_floor_;
  std::unordered_map<CellNodes, CellTemplate> known_;
};

/// The quality floor that start meshes keep, whatever the labels: the least radius ratio of the
/// tets that they can consist of.
///
/// These are finitely many up to their size: the five tets of Sec 5.1 in both patterns, and, when
/// cells may be larger than a voxel, those between a cell's centre and a triangle of one of its
/// faces, for every set of hanging nodes that a face can have.  Cells with an apex on their surface
/// do not matter: cut_cell() takes one only when its tets reach the floor or those of the centre.
/// max_level is that of StartOptions.
/// ENSURES: no tet of graded_start() is below the floor asked of it, if that is at most the result.
/// Cost: some 2,000 tets.
[[nodiscard]] double min_start_ratio(const Metric& metric, int max_level);

}  // namespace mw
