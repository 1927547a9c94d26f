// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sorts the triangles of all tets of a block, so that equal ones of two tets follow one another.
#include "engine/output/block_triangles.h"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

namespace mw::engine {
namespace {

/// A triangle of a tet.
struct Face {
  TriangleRows rows{};
  std::uint32_t tet = 0;
};

/// Returns the triangles of all tets, sorted by rows.
std::vector<Face> faces_of(const BlockMesh& block) {
  std::vector<Face> out;
  out.reserve(4 * block.tets.size());
  for (std::uint32_t t = 0; t < block.tets.size(); ++t) {
    const auto& [a, b, c, d] = block.tets[t].vertices;
    for (const TriangleRows& rows : {TriangleRows{a, b, c}, {a, b, d}, {a, c, d}, {b, c, d}}) {
      out.push_back({rows, t});
    }
  }
  std::sort(out.begin(), out.end(), [](const Face& a, const Face& b) {
    return std::tie(a.rows, a.tet) < std::tie(b.rows, b.tet);
  });
  return out;
}

class Finder {
 public:
  Finder(const BlockMesh& block, const TriangleScope& scope) : block_(block), scope_(scope) {}

  BlockTriangles run() {
    find_vertices();
    const std::vector<Face> faces = faces_of(block_);
    reserve(faces);
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (i + 1 < faces.size() && faces[i + 1].rows == faces[i].rows) {
        meet(faces[i], faces[i + 1]);
        ++i;
      } else if (!on_box(faces[i])) {
        out_.lone.push_back({faces[i].rows, label(faces[i]), points_out(faces[i])});
      }
    }
    sort();
    return std::move(out_);
  }

 private:
  [[nodiscard]] Point point(std::uint32_t row) const { return block_.vertices[row].position; }
  [[nodiscard]] Label label(const Face& face) const { return block_.tets[face.tet].label; }

  void find_vertices() {
    out_.vertices.reserve(block_.vertices.size());
    for (const BlockVertex& v : block_.vertices) {
      const std::size_t home = raster(scope_.homes.home(v.position), scope_.homes.blocks());
      out_.vertices.push_back({v.id, v.position, home});
    }
  }

  [[nodiscard]] bool is_interface(const Face& face, const Face& other) const {
    return label(face) != label(other) && scope_.selection.keeps(label(face)) &&
           scope_.selection.keeps(label(other));
  }

  /// Reserves room for all entries: a list that grows would take three times as much meanwhile.
  void reserve(std::span<const Face> faces) {
    std::size_t lone = 0;
    std::size_t interfaces = 0;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (i + 1 == faces.size() || faces[i + 1].rows != faces[i].rows) {
        ++lone;
      } else {
        if (is_interface(faces[i], faces[i + 1])) ++interfaces;
        ++i;
      }
    }
    out_.lone.reserve(lone);
    out_.interfaces.reserve(interfaces);
    out_.news.reserve(3 * interfaces + 6 * lone);
  }

  void meet(const Face& face, const Face& other) {
    if (!is_interface(face, other)) return;
    const LabelPair labels = label_pair(label(face), label(other));
    out_.interfaces.push_back(face.rows);
    tell_interface(face.rows, labels, points_out(face) == (label(face) == labels.low), out_.news);
  }

  [[nodiscard]] bool on_box(const Face& face) const {
    const Point a = point(face.rows[0]), b = point(face.rows[1]), c = point(face.rows[2]);
    const auto on_side = [](std::int32_t u, std::int32_t v, std::int32_t w, std::int64_t voxels) {
      return u == v && v == w && (u == 0 || u == voxels * kUnitsPerVoxel);
    };
    return on_side(a.x, b.x, c.x, scope_.shape.x) || on_side(a.y, b.y, c.y, scope_.shape.y) ||
           on_side(a.z, b.z, c.z, scope_.shape.z);
  }

  /// True if (b - a) x (c - a) points out of the face's tet.
  [[nodiscard]] bool points_out(const Face& face) const {
    const auto& [a, b, c] = face.rows;
    for (const std::uint32_t v : block_.tets[face.tet].vertices) {
      if (v != a && v != b && v != c) return volume6(point(v), point(a), point(b), point(c)) > 0;
    }
    return false;
  }

  void sort() {
    std::sort(out_.lone.begin(), out_.lone.end(),
              [&](const LoneTriangle& a, const LoneTriangle& b) {
                return std::tuple(out_.home(a.rows[0]), a.rows) <
                       std::tuple(out_.home(b.rows[0]), b.rows);
              });
    std::sort(out_.news.begin(), out_.news.end(),
              [&](const EdgeNews& a, const EdgeNews& b) { return out_.comes_before(a, b); });
  }

  const BlockMesh& block_;
  const TriangleScope& scope_;
  BlockTriangles out_;
};

}  // namespace

void tell_interface(const TriangleRows& rows, LabelPair labels, bool points_out,
                    std::vector<EdgeNews>& news) {
  const auto& [a, b, c] = rows;
  news.push_back({{a, b}, c, labels, 0, !points_out});
  news.push_back({{b, c}, a, labels, 0, !points_out});
  news.push_back({{a, c}, b, labels, 0, points_out});
}

bool BlockTriangles::comes_before(const EdgeNews& a, const EdgeNews& b) const {
  return std::tuple(home(a.rows[0]), a.rows, a.opens, a.apex) <
         std::tuple(home(b.rows[0]), b.rows, b.opens, b.apex);
}

BlockTriangles triangles_of(const BlockMesh& block, const TriangleScope& scope) {
  return Finder(block, scope).run();
}

}  // namespace mw::engine
