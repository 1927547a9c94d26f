// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Compares places along the box's edges by their numbers in a list, so that rounding has no effect.
#include "io/mesh/grouped/periodic_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "io/file/errors.h"
#include "io/file/sink/atomic_file.h"
#include "io/mesh/grouped/fixed_fields.h"
#include "kernels/core/sort_distinct.h"

namespace mw::io {
namespace {

/// Shares of the box's edge that differ by no more are one place; lattice points are farther apart.
constexpr double kSame = 1e-10;

using Places = std::array<std::uint32_t, 3>;

struct FaceNode {
  std::uint64_t row = 0;
  Places at{};
};

bool is_periodic_side(Side side, unsigned axes) {
  if (side == Side::kInterface || side == Side::kOuter) return false;
  const auto axis = (static_cast<unsigned>(side) - 1) / 2;
  return (axes >> axis & 1U) != 0;
}

std::vector<std::uint64_t> face_rows(GroupedMesh& mesh, unsigned axes) {
  std::vector<std::uint64_t> rows;
  for (const FacetGroup& group : mesh.facet_groups()) {
    if (!is_periodic_side(group.side, axes)) continue;
    for (std::uint64_t f = group.facets.begin; f < group.facets.end; ++f) {
      for (const std::uint64_t row : mesh.facet_nodes(mesh.facet(f))) rows.push_back(row);
    }
  }
  sort_distinct(rows);
  return rows;
}

/// The low face and the places of nodes along an axis in ascending order, each once.
class PlaceList {
 public:
  explicit PlaceList(std::vector<double> shares) {
    shares.push_back(0.0);
    std::sort(shares.begin(), shares.end());
    for (const double share : shares) {
      if (places_.empty() || share - last_ > kSame) places_.push_back(share);
      last_ = share;
    }
  }
  [[nodiscard]] std::uint32_t number(double share) const {
    const auto next = std::upper_bound(places_.begin(), places_.end(), share);
    return static_cast<std::uint32_t>(next - places_.begin() - (next == places_.begin() ? 0 : 1));
  }
  [[nodiscard]] bool is_end(std::uint32_t number) const {
    return std::abs(places_[number] - 1) <= kSame;
  }

 private:
  std::vector<double> places_;
  double last_ = 0;
};

bool by_place(const FaceNode& a, const FaceNode& b) {
  return a.at < b.at;
}

/// Returns the axes on whose high face a node is.
unsigned high_axes(const FaceNode& node, const std::vector<PlaceList>& lists, unsigned axes) {
  unsigned out = 0;
  for (unsigned k = 0; k < 3; ++k) {
    if ((axes >> k & 1U) != 0 && lists[k].is_end(node.at[k])) out |= 1U << k;
  }
  return out;
}

/// Finds nodes by their rows, and by their places.
class FaceNodes {
 public:
  /// REQUIRES: nodes ascend by row.
  explicit FaceNodes(std::vector<FaceNode> nodes) : by_row_(std::move(nodes)), placed_(by_row_) {
    std::sort(placed_.begin(), placed_.end(), by_place);
  }
  [[nodiscard]] const std::vector<FaceNode>& all() const { return by_row_; }
  /// Returns the node at the same place on the low faces of these axes, if there is one.
  [[nodiscard]] std::optional<std::uint64_t> partner(FaceNode node, unsigned axes) const {
    for (unsigned k = 0; k < 3; ++k) {
      if ((axes >> k & 1U) != 0) node.at[k] = 0;
    }
    const auto at = std::lower_bound(placed_.begin(), placed_.end(), node, by_place);
    return at == placed_.end() || at->at != node.at ? std::nullopt : std::optional(at->row);
  }
  /// Returns a node by its row.  REQUIRES: the row is that of one of the nodes.
  [[nodiscard]] const FaceNode& at_row(std::uint64_t row) const {
    return *std::lower_bound(by_row_.begin(), by_row_.end(), row,
                             [](const FaceNode& a, std::uint64_t b) { return a.row < b; });
  }

 private:
  std::vector<FaceNode> by_row_;
  std::vector<FaceNode> placed_;
};

using Triangle = std::array<std::uint64_t, 3>;

/// Returns the triangles of a side, ascending.  Those of a high side have the partners of their
/// corners; a corner without a partner keeps its own row.
std::vector<Triangle> triangles_of(GroupedMesh& mesh, const FaceNodes& nodes, unsigned axis,
                                   bool is_high) {
  std::vector<Triangle> out;
  for (const FacetGroup& group : mesh.facet_groups()) {
    if (static_cast<unsigned>(group.side) != 1 + 2 * axis + (is_high ? 1 : 0)) continue;
    for (std::uint64_t f = group.facets.begin; f < group.facets.end; ++f) {
      Triangle rows = mesh.facet(f).rows;
      for (std::uint64_t& row : rows) {
        if (is_high) row = nodes.partner(nodes.at_row(row), 1U << axis).value_or(row);
      }
      std::sort(rows.begin(), rows.end());
      out.push_back(rows);
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::uint64_t count_unlike(GroupedMesh& mesh, const FaceNodes& nodes, unsigned axis) {
  const std::vector<Triangle> low = triangles_of(mesh, nodes, axis, false);
  const std::vector<Triangle> high = triangles_of(mesh, nodes, axis, true);
  std::vector<Triangle> unlike;
  std::set_symmetric_difference(low.begin(), low.end(), high.begin(), high.end(),
                                std::back_inserter(unlike));
  return unlike.size();
}

/// The most terms of an equation that stand on a line.
constexpr std::size_t kTermsOnLine = 4;

void write_table(AtomicFile& file, const PeriodicPairs& found) {
  file.append(std::string_view("node,image_of,x,y,z\n"));
  for (const PeriodicPair& p : found.pairs) {
    file.append(text(p.node + 1, ",", p.image_of + 1, ",", p.axes & 1U, ",", p.axes >> 1U & 1U, ",",
                     p.axes >> 2U & 1U, "\n"));
  }
}

void write_equation(AtomicFile& file, const PeriodicPair& p,
                    const std::array<std::uint64_t, 3>& references, int freedom) {
  std::vector<std::string> terms{text(p.node + 1, ",", freedom, ",1."),
                                 text(p.image_of + 1, ",", freedom, ",-1.")};
  for (unsigned k = 0; k < 3; ++k) {
    if ((p.axes >> k & 1U) != 0) terms.push_back(text(references[k], ",", freedom, ",-1."));
  }
  file.append(text("*EQUATION\n", terms.size(), "\n"));
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const bool ends = i + 1 == terms.size() || i % kTermsOnLine == kTermsOnLine - 1;
    file.append(text(terms[i], ends ? "\n" : ","));
  }
}

}  // namespace

unsigned recorded_axes(const GroupedMesh& mesh) {
  const MeshRecord& record = mesh.header().record;
  return record.promises ? record.promises->periodic : 0;
}

std::array<std::uint64_t, 3> write_equations(AtomicFile& file, GroupedMesh& mesh,
                                             const PeriodicPairs& found,
                                             std::span<const int> freedoms) {
  std::array<std::uint64_t, 3> references{};
  std::uint64_t next = mesh.node_count();
  file.append(text("** a node on a high face moves as its partner on the low face and the ",
                   "reference nodes\n** of the axes between them; nodes without a partner: ",
                   found.alone, "\n"));
  for (unsigned k = 0; k < 3; ++k) {
    if ((recorded_axes(mesh) >> k & 1U) == 0) continue;
    references[k] = ++next;
    const Position& first = mesh.box().origin;
    const Position& edge = mesh.box().edges[k];
    file.append(text("*NODE, NSET=PERIODIC_", std::string_view("XYZ").substr(k, 1), "\n", next,
                     ", ", inp_real(first[0] + edge[0]), ", ", inp_real(first[1] + edge[1]), ", ",
                     inp_real(first[2] + edge[2]), "\n"));
  }
  for (const PeriodicPair& p : found.pairs) {
    for (const int freedom : freedoms) write_equation(file, p, references, freedom);
  }
  return references;
}

PeriodicPairs recorded_pairs(GroupedMesh& mesh, const std::string& name) {
  const MeshRecord& record = mesh.header().record;
  const unsigned axes = recorded_axes(mesh);
  if (axes == 0) {
    const char* const why = record.promises ? ": the mesh was not made with --periodic"
                                            : ": the mesh's file does not tell whether it was "
                                              "made with --periodic; take the run's own file";
    fail_usage(name + why);
  }
  if (record.has_doubles) {
    fail_usage(name +
               ": vertices of the mesh were doubled (--split, "
               "--cohesive, --open-hinges), so pairs are not known");
  }
  PeriodicPairs found = periodic_pairs(mesh, axes);
  const bool is_whole =
      record.only_labels.empty() && record.without_labels.empty() && record.partial_labels.empty();
  if (is_whole && found.alone + found.unlike > 0) {
    throw Error(ErrorKind::kInternal,
                text(name, ": ", found.alone, " nodes on faces have no partner, and ", found.unlike,
                     " triangles are on one of two faces alone"));
  }
  return found;
}

PeriodicPairs periodic_pairs(GroupedMesh& mesh, unsigned axes) {
  const std::vector<std::uint64_t> rows = face_rows(mesh, axes);
  std::vector<FaceNode> nodes;
  for (const std::uint64_t row : rows) nodes.push_back({.row = row});
  std::vector<PlaceList> lists;
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<double> shares;
    for (const std::uint64_t row : rows) {
      shares.push_back(share_along(mesh.box(), k, mesh.node(row)));
    }
    lists.emplace_back(shares);
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i].at[k] = lists[k].number(shares[i]);
  }
  const FaceNodes found(std::move(nodes));
  PeriodicPairs out;
  for (const FaceNode& node : found.all()) {
    const unsigned high = high_axes(node, lists, axes);
    if (high == 0) continue;
    if (const auto partner = found.partner(node, high)) {
      out.pairs.push_back({node.row, *partner, high});
    } else {
      ++out.alone;
    }
  }
  for (unsigned axis = 0; axis < 3; ++axis) {
    if ((axes >> axis & 1U) != 0) out.unlike += count_unlike(mesh, found, axis);
  }
  return out;
}

WriteGrouped open_pairs(const std::filesystem::path& path) {
  if (path.extension() != ".csv" && path.extension() != ".inp") {
    fail_usage(path.string() + ": pairs of nodes are written as .csv, or as equations in .inp");
  }
  const auto file = std::make_shared<AtomicFile>(path);
  return [file, path](GroupedMesh& mesh) {
    const PeriodicPairs found = recorded_pairs(mesh, path.string());
    if (path.extension() == ".inp") {
      constexpr std::array<int, 3> kDisplacements{1, 2, 3};
      write_equations(*file, mesh, found, kDisplacements);
    } else {
      write_table(*file, found);
    }
    file->commit();
  };
}

}  // namespace mw::io
