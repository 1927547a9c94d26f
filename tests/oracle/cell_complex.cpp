// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Oracle for Betti numbers: explicit complexes and ranks over GF(2).
#include "tests/oracle/cell_complex.h"

#include <algorithm>
#include <iterator>
#include <map>

namespace mw::audit::test {
namespace {

/// Rank over GF(2) of a matrix of sparse ascending columns, by reduction from the lowest row up.
std::int64_t rank_of(std::vector<std::vector<std::size_t>> columns) {
  std::map<std::size_t, std::vector<std::size_t>> by_pivot;
  for (auto& column : columns) {
    while (!column.empty()) {
      const auto found = by_pivot.find(column.back());
      if (found == by_pivot.end()) break;
      std::vector<std::size_t> sum;
      std::set_symmetric_difference(column.begin(), column.end(), found->second.begin(),
                                    found->second.end(), std::back_inserter(sum));
      column = std::move(sum);
    }
    if (!column.empty()) by_pivot.emplace(column.back(), column);
  }
  return static_cast<std::int64_t>(by_pivot.size());
}

/// Ids of simplices by their vertices; adds those that are new, with their faces.
class Simplices {
 public:
  explicit Simplices(CellComplex& complex) : complex_(complex) {}

  std::size_t id(const std::vector<std::uint64_t>& vertices) {
    const auto found = ids_.find(vertices);
    if (found != ids_.end()) return found->second;
    std::vector<std::size_t> boundary;
    for (std::size_t skip = 0; vertices.size() > 1 && skip < vertices.size(); ++skip) {
      std::vector<std::uint64_t> face = vertices;
      face.erase(face.begin() + static_cast<std::ptrdiff_t>(skip));
      boundary.push_back(id(face));
      if (face.size() == 3) ++tets_on_[boundary.back()];
    }
    const std::size_t cell = complex_.add(vertices.size() - 1, boundary);
    ids_.emplace(vertices, cell);
    return cell;
  }

  [[nodiscard]] std::vector<std::size_t> faces_of_one_tet() const {
    std::vector<std::size_t> faces;
    for (const auto& [face, tets] : tets_on_) {
      if (tets == 1) faces.push_back(face);
    }
    return faces;
  }

 private:
  CellComplex& complex_;
  std::map<std::vector<std::uint64_t>, std::size_t> ids_;
  std::map<std::size_t, int> tets_on_;
};

/// Calls visit for every subset of 2 .. most labels.
template <class Visit>
void each_subset(const std::set<Label>& all, std::size_t max, Visit visit) {
  std::vector<std::set<Label>> subsets{{}};
  for (const Label label : all) {
    for (std::size_t i = 0, count = subsets.size(); i < count; ++i) {
      if (subsets[i].size() == max) continue;
      subsets.push_back(subsets[i]);
      subsets.back().insert(label);
    }
  }
  for (const std::set<Label>& s : subsets) {
    if (s.size() >= 2) visit(s);
  }
}

/// Cells of a cubical grid by doubled coordinates; odd coordinates extend.
class CubicalGrid {
 public:
  CubicalGrid(CellComplex& complex, Index3 shape)
      : complex_(complex), size_{2 * shape.x + 1, 2 * shape.y + 1, 2 * shape.z + 1} {
    ids_.resize(static_cast<std::size_t>(size_.product()));
    for (std::size_t dimension = 0; dimension <= 3; ++dimension) add_all(dimension);
  }

  [[nodiscard]] std::size_t voxel(std::int64_t i) const {
    const std::int64_t nx = size_.x / 2, ny = size_.y / 2;
    return at({2 * (i % nx) + 1, 2 * (i / nx % ny) + 1, 2 * (i / nx / ny) + 1});
  }
  [[nodiscard]] const std::vector<std::size_t>& surface() const { return surface_; }

 private:
  [[nodiscard]] std::size_t at(Index3 c) const {
    return ids_[static_cast<std::size_t>((c.z * size_.y + c.y) * size_.x + c.x)];
  }

  void add_all(std::size_t dimension) {
    for (std::int64_t i = 0; i < size_.product(); ++i) {
      const Index3 c{i % size_.x, i / size_.x % size_.y, i / size_.x / size_.y};
      if (static_cast<std::size_t>(c.x % 2 + c.y % 2 + c.z % 2) == dimension) {
        ids_[static_cast<std::size_t>(i)] = add(c, dimension);
      }
    }
  }

  std::size_t add(Index3 c, std::size_t dimension) {
    std::vector<std::size_t> boundary;
    for (const std::int64_t s : {-1, 1}) {
      if (c.x % 2 == 1) boundary.push_back(at({c.x + s, c.y, c.z}));
      if (c.y % 2 == 1) boundary.push_back(at({c.x, c.y + s, c.z}));
      if (c.z % 2 == 1) boundary.push_back(at({c.x, c.y, c.z + s}));
    }
    const std::size_t id = complex_.add(dimension, boundary);
    const bool outer = c.x == 0 || c.y == 0 || c.z == 0 || c.x == size_.x - 1 ||
                       c.y == size_.y - 1 || c.z == size_.z - 1;
    if (dimension == 2 && outer) surface_.push_back(id);
    return id;
  }

  CellComplex& complex_;
  Index3 size_;
  std::vector<std::size_t> ids_;
  std::vector<std::size_t> surface_;
};

}  // namespace

std::size_t CellComplex::add(std::size_t dimension, std::vector<std::size_t> boundary) {
  std::sort(boundary.begin(), boundary.end());
  cells_.push_back({dimension, std::move(boundary), {}});
  return cells_.size() - 1;
}

void CellComplex::set_label(std::size_t cell, Label label) {
  cells_[cell].above = {label};
}

void CellComplex::spread_labels() {
  for (std::size_t dimension = 3; dimension > 0; --dimension) {
    for (const Cell& cell : cells_) {
      if (cell.dimension != dimension) continue;
      for (const std::size_t face : cell.boundary) {
        cells_[face].above.insert(cell.above.begin(), cell.above.end());
      }
    }
  }
}

std::int64_t CellComplex::boundary_rank(const Cells& kept, std::size_t dimension) const {
  std::vector<std::vector<std::size_t>> columns;
  for (const std::size_t i : kept) {
    if (cells_[i].dimension != dimension) continue;
    columns.emplace_back();
    for (const std::size_t face : cells_[i].boundary) {
      if (std::binary_search(kept.begin(), kept.end(), face)) columns.back().push_back(face);
    }
  }
  return rank_of(std::move(columns));
}

std::vector<std::int64_t> CellComplex::homology(const Cells& kept) const {
  std::vector<std::int64_t> betti(4, 0);
  for (const std::size_t i : kept) ++betti[cells_[i].dimension];
  for (std::size_t dimension = 1; dimension <= 3; ++dimension) {
    const std::int64_t rank = boundary_rank(kept, dimension);
    betti[dimension] -= rank;
    betti[dimension - 1] -= rank;
  }
  return betti;
}

Betti CellComplex::closed(Label label) const {
  Cells kept;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (cells_[i].above.count(label) > 0) kept.push_back(i);
  }
  const auto b = homology(kept);
  return {b[0], b[1], b[2]};
}

Betti CellComplex::open(Label label) const {
  Cells kept;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (cells_[i].above == std::set<Label>{label}) kept.push_back(i);
  }
  // The dual block of a cell of dimension k has dimension 3 - k, and its boundary map is the
  // transpose, of the same rank.
  const auto b = homology(kept);
  return {b[3], b[2], b[1]};
}

BettiOfJunctions CellComplex::betti_of(const std::map<std::set<Label>, Cells>& junctions) const {
  BettiOfJunctions out;
  for (const auto& [labels, cells] : junctions) {
    const auto b = homology(cells);
    out[labels] = {b[0], b[1], b[2]};
  }
  return out;
}

BettiOfJunctions CellComplex::meetings(std::size_t max) const {
  std::map<std::set<Label>, Cells> junctions;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    each_subset(cells_[i].above, max, [&](const std::set<Label>& s) { junctions[s].push_back(i); });
  }
  return betti_of(junctions);
}

BettiOfJunctions CellComplex::interfaces() const {
  std::map<std::set<Label>, std::set<std::size_t>> closures;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (cells_[i].dimension != 2 || cells_[i].above.size() != 2) continue;
    std::set<std::size_t>& closure = closures[cells_[i].above];
    closure.insert(i);
    for (const std::size_t edge : cells_[i].boundary) {
      closure.insert(edge);
      closure.insert(cells_[edge].boundary.begin(), cells_[edge].boundary.end());
    }
  }
  std::map<std::set<Label>, Cells> junctions;
  for (const auto& [pair, cells] : closures) junctions[pair] = {cells.begin(), cells.end()};
  return betti_of(junctions);
}

CellComplex complex_of(const VoxelLabels& volume, std::size_t label_count) {
  CellComplex complex;
  const CubicalGrid grid(complex, volume.shape);
  for (std::int64_t i = 0; i < volume.shape.product(); ++i) {
    complex.set_label(grid.voxel(i), volume.labels[static_cast<std::size_t>(i)]);
  }
  complex.set_label(complex.add(3, grid.surface()), static_cast<Label>(label_count));
  complex.spread_labels();
  return complex;
}

CellComplex complex_of(const AuditMesh& mesh, std::size_t label_count) {
  CellComplex complex;
  Simplices simplices(complex);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    std::vector<std::uint64_t> vertices(mesh.tets[t].begin(), mesh.tets[t].end());
    std::sort(vertices.begin(), vertices.end());
    complex.set_label(simplices.id(vertices), mesh.labels[t]);
  }
  const std::size_t outside = complex.add(3, simplices.faces_of_one_tet());
  complex.set_label(outside, static_cast<Label>(label_count));
  complex.spread_labels();
  return complex;
}

JunctionsBetti junctions_of(const CellComplex& complex) {
  constexpr std::size_t kMaxLabels = 4;
  return {complex.meetings(kMaxLabels), complex.interfaces()};
}

std::vector<RegionBetti> betti_of(const CellComplex& complex, std::size_t label_count) {
  std::vector<RegionBetti> betti;
  for (std::size_t label = 0; label <= label_count; ++label) {
    const auto l = static_cast<Label>(label);
    betti.push_back({complex.closed(l), complex.open(l)});
  }
  return betti;
}

}  // namespace mw::audit::test
