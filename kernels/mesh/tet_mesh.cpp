// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Stars of link triangles: construction, contraction and the two primitive edits of flips.
#include "kernels/mesh/tet_mesh.h"

#include <algorithm>
#include <cstring>

#include "kernels/core/lanes.h"
#include "kernels/core/sort_distinct.h"

namespace mw {
namespace {

BoxPlanes planes_of(Point p, Point box) {
  unsigned planes = 0;
  if (p.x == 0) planes |= 1U;
  if (p.x == box.x) planes |= 2U;
  if (p.y == 0) planes |= 4U;
  if (p.y == box.y) planes |= 8U;
  if (p.z == 0) planes |= 16U;
  if (p.z == box.z) planes |= 32U;
  return static_cast<BoxPlanes>(planes);
}

LabelBits bits_of(std::span<const BlockTet> tets) {
  std::vector<Label> labels{without_side(kExterior)};
  for (const BlockTet& t : tets) {
    if (without_side(t.label) != labels.back()) labels.push_back(without_side(t.label));
  }
  sort_distinct(labels);
  return LabelBits(labels);
}

/// Returns bit 0, 1 or 2 where the vertex is a, b or c; 0 where it is none of them.
unsigned corner_bit(const LinkTriangle& t, LocalVertex v) {
  LaneInts rows;
  static_assert(sizeof t == sizeof rows);
  std::memcpy(&rows, &t, sizeof rows);
  return lane_bits(rows == static_cast<std::int32_t>(v)) & 7U;
}

}  // namespace

TetMesh::TetMesh(std::span<const BlockVertex> vertices, std::span<const BlockTet> tets, Point box,
                 BoxPlanes inner)
    : inner_(inner), bits_(bits_of(tets)), marks_(vertices.size() + 1) {
  points_.reserve(vertices.size());
  ids_.reserve(vertices.size());
  quadrics_.reserve(vertices.size());
  planes_.reserve(vertices.size());
  for (const BlockVertex& v : vertices) {
    points_.push_back(v.position);
    ids_.push_back(v.id);
    quadrics_.push_back(v.quadric);
    planes_.push_back(planes_of(v.position, box));
  }

  std::vector<LocalTet> loaded;
  loaded.reserve(tets.size() + tets.size() / 8);
  for (const BlockTet& t : tets) {
    LocalTet tet{t.vertices, t.label};
    auto& v = tet.vertices;
    if (volume6(position(v[0]), position(v[1]), position(v[2]), position(v[3])) < 0) {
      std::swap(v[2], v[3]);
    }
    tet.label |= side_of(v, box);
    loaded.push_back(tet);
  }
  const std::size_t real = loaded.size();
  for (std::size_t i = 0; i < real; ++i) {
    const auto v = loaded[i].vertices;
    const unsigned outer = 63U & ~unsigned{inner_};
    const unsigned p0 = planes_[v[0]], p1 = planes_[v[1]], p2 = planes_[v[2]], p3 = planes_[v[3]];
    // Any three corners have either the first two or the last two among them.
    if ((((p0 & p1) | (p2 & p3)) & outer) == 0) continue;
    // The face opposite each corner, turned so that the virtual tet beyond it is positive.
    const std::array<LocalTet, 4> beyond{{{{infinity(), v[2], v[1], v[3]}, kExterior},
                                          {{v[0], infinity(), v[3], v[2]}, kExterior},
                                          {{v[1], v[0], infinity(), v[3]}, kExterior},
                                          {{v[0], v[2], v[1], infinity()}, kExterior}}};
    for (std::size_t corner = 0; corner < 4; ++corner) {
      unsigned shared = outer;
      for (std::size_t j = 0; j < 4; ++j) {
        if (j != corner) shared &= planes_[v[j]];
      }
      if (shared != 0) loaded.push_back(beyond[corner]);
    }
  }
  count_stars(loaded);
  for (const LocalTet& t : loaded) {
    for (int i = 0; i < 4; ++i) {
      const LocalVertex v = t.vertices[static_cast<std::size_t>(i)];
      if (v == infinity()) continue;
      pool_[stars_[v].begin + stars_[v].size++] = link_triangle(t, i);
    }
  }
  versions_.assign(points_.size(), 0);
  classify_vertices();
}

/// Returns the sides of a tet, which no inner plane crosses.
Label TetMesh::side_of(const std::array<LocalVertex, 4>& tet, Point box) const {
  if (inner_ == 0) return 0;
  Label sides = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    if ((inner_ >> 2 * axis & 3U) == 0) continue;
    const bool is_beyond = std::any_of(tet.begin(), tet.end(), [&](LocalVertex v) {
      return along(points_[v], axis) > along(box, axis);
    });
    if (is_beyond) sides |= side_beyond(axis);
  }
  return sides;
}

void TetMesh::count_stars(std::span<const LocalTet> tets) {
  stars_.assign(points_.size(), {});
  for (const LocalTet& t : tets) {
    for (LocalVertex v : t.vertices) {
      if (v != infinity()) ++stars_[v].capacity;
    }
  }
  std::uint32_t begin = 0;
  for (Star& s : stars_) {
    s.begin = begin;
    begin += s.capacity;
  }
  pool_.resize(begin);
}

/// An edge is met at its smaller end, and counts at both.
std::vector<std::uint32_t> TetMesh::count_link_vertices() {
  std::vector<std::uint32_t> out(points_.size() + 1);
  for (LocalVertex v = 0; v < vertex_count(); ++v) {
    marks_.clear();
    for (const LinkTriangle& t : star(v)) {
      for (LocalVertex w : {t.a, t.b, t.c}) {
        if (w < v || !marks_.insert(w)) continue;
        ++out[v];
        ++out[w];
      }
    }
  }
  return out;
}

void TetMesh::classify_vertices() {
  free_.assign(points_.size(), 0);
  orders_.assign(points_.size(), 0);
  signatures_.assign(points_.size(), 0);
  const std::vector<std::uint32_t> link_vertices = count_link_vertices();
  for (LocalVertex v = 0; v < vertex_count(); ++v) {
    free_[v] = 2 * link_vertices[v] == stars_[v].size + 4 ? 1 : 0;
    classify_labels(v);
  }
}

void TetMesh::classify_labels(LocalVertex v) {
  std::array<Label, 255> seen;
  std::size_t count = 0;
  std::uint64_t signature = 0;
  bool has_exterior = false;
  const LinkTriangle* before = nullptr;
  for (const LinkTriangle& t : star(v)) {
    if (before != nullptr && before->label == t.label) continue;
    before = &t;
    signature |= label_bit(t.label);
    has_exterior |= t.label == kExterior;
    const Label label = without_side(t.label);
    const auto end = seen.begin() + static_cast<std::ptrdiff_t>(count);
    if (count < seen.size() && std::find(seen.begin(), end, label) == end) seen[count++] = label;
  }
  if ((planes_[v] & inner_) != 0 && !has_exterior && count < seen.size()) ++count;
  orders_[v] = static_cast<std::uint8_t>(count);
  signatures_[v] = is_free(v) ? signature : ~std::uint64_t{0};
}

void TetMesh::reserve(LocalVertex v, std::uint32_t capacity) {
  Star& s = stars_[v];
  if (s.capacity >= capacity) return;
  if (pool_.capacity() - pool_.size() < capacity) compact(capacity);
  const auto begin = static_cast<std::uint32_t>(pool_.size());
  pool_.resize(pool_.size() + capacity);
  std::copy_n(pool_.begin() + s.begin, s.size, pool_.begin() + begin);
  s.begin = begin;
  s.capacity = capacity;
}

void TetMesh::compact(std::uint32_t room) {
  std::size_t alive = 0;
  for (const Star& s : stars_) alive += s.size;
  std::vector<LinkTriangle> pool;
  pool.reserve(alive + alive / 2 + room);
  for (Star& s : stars_) {
    const auto star = pool_.begin() + s.begin;
    s.begin = static_cast<std::uint32_t>(pool.size());
    pool.insert(pool.end(), star, star + s.size);
    s.capacity = s.size;
  }
  pool_ = std::move(pool);
}

void TetMesh::append(LocalVertex v, LinkTriangle triangle) {
  if (stars_[v].size == stars_[v].capacity) reserve(v, 2 * stars_[v].capacity + 8);
  Star& s = stars_[v];
  pool_[s.begin + s.size++] = triangle;
}

void TetMesh::erase(LocalVertex v, std::uint32_t index) {
  Star& s = stars_[v];
  pool_[s.begin + index] = pool_[s.begin + --s.size];
}

void TetMesh::replace_in_link(LocalVertex keep, LocalVertex drop) {
  marks_.clear();
  marks_.insert(keep);
  marks_.insert(infinity());
  for (std::uint32_t i = 0; i < stars_[drop].size; ++i) {
    const LinkTriangle t = pool_[stars_[drop].begin + i];
    for (LocalVertex w : {t.a, t.b, t.c}) {
      if (!marks_.insert(w)) continue;
      for (std::uint32_t k = 0; k < stars_[w].size;) {
        LinkTriangle& u = pool_[stars_[w].begin + k];
        const unsigned corner = corner_bit(u, drop);
        if (corner != 0 && u.has(keep)) {
          erase(w, k);
          continue;
        }
        if (corner != 0) ((corner & 1U) != 0 ? u.a : (corner & 2U) != 0 ? u.b : u.c) = keep;
        ++k;
      }
    }
  }
}

void TetMesh::merge_stars(LocalVertex keep, LocalVertex drop) {
  for (std::uint32_t k = 0; k < stars_[keep].size;) {
    if (pool_[stars_[keep].begin + k].has(drop)) {
      erase(keep, k);
    } else {
      ++k;
    }
  }
  reserve(keep, stars_[keep].size + stars_[drop].size);
  for (std::uint32_t i = 0; i < stars_[drop].size; ++i) {
    const LinkTriangle t = pool_[stars_[drop].begin + i];
    if (!t.has(keep)) append(keep, t);
  }
  stars_[drop].size = 0;
}

void TetMesh::contract(LocalVertex keep, LocalVertex drop, Point position, const Quadric& quadric) {
  MW_ASSERT(is_free(keep) && is_free(drop));
  replace_in_link(keep, drop);
  merge_stars(keep, drop);
  classify_labels(keep);
  move(keep, position, quadric);
}

void TetMesh::move(LocalVertex v, Point position, const Quadric& quadric) {
  MW_ASSERT(is_free(v));
  points_[v] = position;
  quadrics_[v] = quadric;
  ++versions_[v];
  ++changes_;
}

void TetMesh::add_tet(const LocalTet& tet) {
  ++changes_;
  for (int i = 0; i < 4; ++i) {
    const LocalVertex v = tet.vertices[static_cast<std::size_t>(i)];
    if (v != infinity()) append(v, link_triangle(tet, i));
  }
}

std::uint32_t TetMesh::row_of(LocalVertex v, const LinkTriangle& wanted) const {
  const auto entries = star(v);
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const LinkTriangle& t) {
    return t.has(wanted.a) && t.has(wanted.b) && t.has(wanted.c);
  });
  MW_ASSERT(found != entries.end());
  return static_cast<std::uint32_t>(found - entries.begin());
}

void TetMesh::remove_tet(const LocalTet& tet) {
  ++changes_;
  for (int i = 0; i < 4; ++i) {
    const LocalVertex v = tet.vertices[static_cast<std::size_t>(i)];
    if (v == infinity()) continue;
    erase(v, row_of(v, link_triangle(tet, i)));
    ++versions_[v];
  }
}

void TetMesh::relabel(const LocalTet& tet, Label label) {
  ++changes_;
  for (int i = 0; i < 4; ++i) {
    const LocalVertex v = tet.vertices[static_cast<std::size_t>(i)];
    if (v == infinity()) continue;
    pool_[stars_[v].begin + row_of(v, link_triangle(tet, i))].label = label;
    ++versions_[v];
    classify_labels(v);
  }
}

std::vector<LocalTet> TetMesh::tets() const {
  std::vector<LocalTet> out;
  for (LocalVertex v = 0; v < vertex_count(); ++v) {
    for (const LinkTriangle& t : star(v)) {
      if (v < t.a && v < t.b && v < t.c && t.label != kExterior) {
        out.push_back({{v, t.a, t.b, t.c}, t.label});
      }
    }
  }
  return out;
}

std::vector<BlockTet> TetMesh::sorted_tets() const {
  std::vector<BlockTet> out;
  for (LocalVertex v = 0; v < vertex_count(); ++v) {
    const auto first = static_cast<std::ptrdiff_t>(out.size());
    for (const LinkTriangle& t : star(v)) {
      if (v > t.a || v > t.b || v > t.c || t.label == kExterior) continue;
      const auto [low, high] = std::minmax({t.a, t.b, t.c});
      out.push_back({{v, low, t.a ^ t.b ^ t.c ^ low ^ high, high}, t.label});
    }
    std::sort(out.begin() + first, out.end());
  }
  return out;
}

}  // namespace mw
