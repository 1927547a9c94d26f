// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Every kind of tet of a start mesh once.
#include "kernels/start/start_quality.h"

#include <algorithm>

#include "kernels/start/cell_template.h"

namespace mw {
namespace {

/// The middles of a face and of its edges.
std::vector<CellNode> middles_on(CellFace face) {
  std::vector<CellNode> out;
  for (CellNode n = 0; n <= 26; ++n) {
    if (is_on(n, face) && !has_node(kCellCorners, n)) out.push_back(n);
  }
  return out;
}

/// Tets between the centre of a cell and a face, whatever hangs on that.
double min_behind(CellFace face, bool odd, const Metric& metric) {
  const std::vector<CellNode> middles = middles_on(face);
  double min = 1.0;
  for (unsigned set = 0; set < 1U << middles.size(); ++set) {
    CellNodes nodes = kCellCorners;
    for (std::size_t i = 0; i < middles.size(); ++i) nodes |= (set >> i & 1U) << middles[i];
    std::vector<NodeTet> tets;
    for (const NodeTriangle& t : face_triangles(nodes, odd, face)) {
      tets.push_back({kCellCentre, t[0], t[1], t[2]});
    }
    min = std::min(min, worst_ratio(tets, metric));
  }
  return min;
}

}  // namespace

double min_start_ratio(const Metric& metric, int max_level) {
  double min = 1.0;
  for (const bool odd : {false, true}) {
    min = std::min(min, worst_ratio(cut_cell(kCellCorners, odd, metric).tets, metric));
    if (max_level == 0) continue;
    for (const unsigned axis : {0U, 1U, 2U}) {
      min = std::min(
          {min, min_behind({axis, false}, odd, metric), min_behind({axis, true}, odd, metric)});
    }
  }
  return min;
}

}  // namespace mw
