// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Fans of faces, and cones over them.
#include "kernels/start/cells/cell_template.h"

#include <algorithm>
#include <utility>

#include "kernels/quality/star_batch.h"

namespace mw {
namespace {

constexpr std::array<CellFace, 6> kFaces{
    {{0, false}, {0, true}, {1, false}, {1, true}, {2, false}, {2, true}}};

/// Start meshes must keep above the default quality floor, with something to spare.
constexpr double kMinShape = 0.25;

bool is_odd_corner(CellNode node, bool odd) {
  const unsigned sum = (node_along(node, 0) + node_along(node, 1) + node_along(node, 2)) / 2;
  return (sum % 2 != 0) != odd;
}

/// Nodes around a face, a corner first.
std::vector<CellNode> rim_of(CellNodes nodes, CellFace face) {
  const CellNode u = node_step(face.axis == 0 ? 1 : 0), v = node_step(face.axis == 2 ? 1 : 2);
  const CellNode lowest = face.high ? 2 * node_step(face.axis) : 0;
  std::vector<CellNode> rim;
  for (const CellNode step : {0 * u, u, 2 * u, 2 * u + v, 2 * u + 2 * v, u + 2 * v, 2 * v, v}) {
    if (has_node(nodes, lowest + step)) rim.push_back(lowest + step);
  }
  return rim;
}

CellNode middle_of(CellFace face) {
  return kCellCentre + (face.high ? 1 : 0) * 2 * node_step(face.axis) - node_step(face.axis);
}

bool is_middle(CellNode n) {
  return !has_node(kCellCorners, n);
}

/// Cuts off the corners of a face that are between two middles of edges: a fan from one middle
/// would put a flat triangle beside the other.
void cut_corners(std::vector<CellNode>& rim, std::vector<NodeTriangle>& triangles) {
  std::vector<CellNode> rest;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const CellNode before = rim[(i + rim.size() - 1) % rim.size()];
    const CellNode after = rim[(i + 1) % rim.size()];
    if (!is_middle(rim[i]) && is_middle(before) && is_middle(after)) {
      triangles.push_back({rim[i], before, after});
    } else {
      rest.push_back(rim[i]);
    }
  }
  rim = std::move(rest);
}

/// Returns the node from which the rest of a face without a node in its middle is a fan.
/// REQUIRES: rim is what cut_corners() left.
CellNode hub_of(const std::vector<CellNode>& rim, bool odd, CellFace face) {
  const auto has = [&](CellNode n) { return std::find(rim.begin(), rim.end(), n) != rim.end(); };
  const auto middles = std::count_if(rim.begin(), rim.end(), is_middle);
  const auto is_beside_middle = [&](std::size_t i) {
    return is_middle(rim[(i + 1) % rim.size()]) ||
           is_middle(rim[(i + rim.size() - 1) % rim.size()]);
  };
  const auto is_hub = [&](std::size_t i) {
    if (middles == 0) return !is_odd_corner(rim[i], odd);
    if (!is_middle(rim[i])) return middles == 2 && !is_beside_middle(i);
    return middles == 1 || has(2 * middle_of(face) - rim[i]);
  };
  CellNode hub = 27;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    if (is_hub(i)) hub = std::min(hub, rim[i]);
  }
  return hub;
}

std::vector<NodeTet> five_tets(bool odd) {
  std::vector<NodeTet> tets;
  NodeTet even{};
  std::size_t found = 0;
  for (CellNode n = 0; n <= 26; ++n) {
    if (!has_node(kCellCorners, n)) continue;
    if (!is_odd_corner(n, odd)) {
      even[found++] = n;
      continue;
    }
    const auto across = [n](unsigned axis) {
      return node_along(n, axis) == 0 ? n + 2 * node_step(axis) : n - 2 * node_step(axis);
    };
    tets.push_back({n, across(0), across(1), across(2)});
  }
  tets.push_back(even);
  return tets;
}

/// The faces that a node is on, as bits in the order of kFaces.
constexpr std::array<unsigned, 27> faces_by_node() {
  std::array<unsigned, 27> out{};
  for (CellNode n = 0; n < out.size(); ++n) {
    for (unsigned f = 0; f < kFaces.size(); ++f) out[n] |= (is_on(n, kFaces[f]) ? 1U : 0U) << f;
  }
  return out;
}
constexpr std::array<unsigned, 27> kFacesAt = faces_by_node();

/// Where nodes of a cell of two voxels lie.
constexpr std::array<Point, 27> places_by_node() {
  std::array<Point, 27> out{};
  for (CellNode n = 0; n < out.size(); ++n) {
    const auto along = [n](unsigned axis) {
      return static_cast<std::int32_t>(node_along(n, axis)) * kUnitsPerVoxel;
    };
    out[n] = {along(0), along(1), along(2)};
  }
  return out;
}
constexpr std::array<Point, 27> kPlaces = places_by_node();

/// Finds the tets between an apex and the triangles of the faces that it is not on.  Returns false
/// when a triangle of its own faces does not have it as a corner.
bool find_cone(CellNode apex, const std::vector<NodeTriangle>& surface,
               std::vector<NodeTet>& tets) {
  tets.clear();
  for (const NodeTriangle& t : surface) {
    const bool beside = (kFacesAt[apex] & kFacesAt[t[0]] & kFacesAt[t[1]] & kFacesAt[t[2]]) != 0;
    if (!beside) {
      tets.push_back({apex, t[0], t[1], t[2]});
    } else if (std::find(t.begin(), t.end(), apex) == t.end()) {
      return false;
    }
  }
  return true;
}

/// The middles of a face and of its edges.
std::vector<CellNode> middles_on(CellFace face) {
  std::vector<CellNode> out;
  for (CellNode n = 0; n <= 26; ++n) {
    if (is_on(n, face) && !has_node(kCellCorners, n)) out.push_back(n);
  }
  return out;
}

/// Returns the least radius ratio of tets between a cell's centre and a face, over all sets of
/// hanging nodes that the face can have.
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

std::vector<NodeTriangle> face_triangles(CellNodes nodes, bool odd, CellFace face) {
  std::vector<CellNode> rim = rim_of(nodes, face);
  std::vector<NodeTriangle> triangles;
  CellNode hub = middle_of(face);
  if (!has_node(nodes, hub)) {
    cut_corners(rim, triangles);
    hub = hub_of(rim, odd, face);
  }
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const CellNode a = rim[i], b = rim[(i + 1) % rim.size()];
    if (a != hub && b != hub) triangles.push_back({hub, a, b});
  }
  return triangles;
}

double worst_ratio(std::span<const NodeTet> tets, const Metric& metric, double enough) {
  double worst = 1.0;
  for (std::size_t first = 0; first < tets.size() && worst >= enough; first += kLanes) {
    const auto group = tets.subspan(first, std::min(kLanes, tets.size() - first));
    TetLanes lanes;
    for (std::size_t i = 0; i < group.size(); ++i) {
      const auto [p, a, b, c] = group[i];
      const bool is_positive = volume6(kPlaces[p], kPlaces[a], kPlaces[b], kPlaces[c]) > 0;
      lanes.set(i, kPlaces[p], kPlaces[is_positive ? a : b], kPlaces[is_positive ? b : a],
                kPlaces[c]);
    }
    const StoredLanes ratios = radius_ratios(lanes, metric);
    for (std::size_t i = 0; i < group.size(); ++i) worst = std::min(worst, ratios[i]);
  }
  return worst;
}

CellTemplate cut_cell(CellNodes nodes, bool odd, const Metric& metric, double quality_floor) {
  CellTemplate out;
  for (std::size_t f = 0; f < kFaces.size(); ++f) {
    const std::vector<NodeTriangle> triangles = face_triangles(nodes, odd, kFaces[f]);
    out.surface.insert(out.surface.end(), triangles.begin(), triangles.end());
    out.ends[f] = out.surface.size();
  }
  if (nodes == kCellCorners) {
    out.tets = five_tets(odd);
    return out;
  }
  find_cone(kCellCentre, out.surface, out.tets);
  double best = std::min(std::max(kMinShape, quality_floor), worst_ratio(out.tets, metric));
  bool at_centre = true;
  std::vector<NodeTet> tets;
  for (CellNode apex = 0; apex <= 26; ++apex) {
    if (!has_node(nodes, apex) || !find_cone(apex, out.surface, tets)) continue;
    const double worst = worst_ratio(tets, metric, best);
    if (worst < best || (worst == best && !at_centre)) continue;
    best = worst;
    at_centre = false;
    std::swap(out.tets, tets);
  }
  return out;
}

std::span<const NodeTriangle> CellTemplate::on(CellFace face) const {
  const std::size_t f = 2 * face.axis + (face.high ? 1 : 0);
  const std::size_t begin = f == 0 ? 0 : ends[f - 1];
  return std::span(surface).subspan(begin, ends[f] - begin);
}

const CellTemplate& CellTemplates::of(CellNodes nodes, bool odd) {
  constexpr CellNodes kOdd = 1U << 31;
  const auto [entry, fresh] = known_.try_emplace(nodes | (odd ? kOdd : 0));
  if (fresh) entry->second = cut_cell(nodes, odd, metric_, quality_floor_);
  return entry->second;
}

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
