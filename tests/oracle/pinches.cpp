// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Faces that one cell of a label has are its boundary; edges and fans are counted from these.
#include "tests/oracle/pinches.h"

#include <algorithm>
#include <vector>

namespace mw::audit::test {
namespace {

using Face = std::vector<std::uint64_t>;  ///< vertices in cyclic order

/// The faces of a label by their vertices, ascending, and of how many cells they are.
class Boundary {
 public:
  void add(const Face& face) {
    Face key = face;
    std::sort(key.begin(), key.end());
    auto& [cells, vertices] = faces_[key];
    ++cells;
    vertices = face;
  }

  [[nodiscard]] Pinched pinched() const {
    std::map<EdgeKey, int> faces_at;
    std::map<std::uint64_t, Fan> fans;
    for (const auto& [key, face] : faces_) {
      if (face.first != 1) continue;
      const Face& v = face.second;
      for (std::size_t i = 0; i < v.size(); ++i) {
        const std::uint64_t before = v[(i + v.size() - 1) % v.size()],
                            after = v[(i + 1) % v.size()];
        ++faces_at[std::minmax(v[i], after)];
        fans[v[i]][before].push_back(after);
        fans[v[i]][after].push_back(before);
      }
    }
    Pinched out;
    for (const auto& [edge, count] : faces_at) {
      if (count > 2) out.edges.insert(edge);
    }
    for (const auto& [vertex, fan] : fans) {
      if (!is_one_cycle(fan)) out.vertices.insert(vertex);
    }
    return out;
  }

 private:
  /// What is joined to each neighbour of a vertex by a face.
  using Fan = std::map<std::uint64_t, std::vector<std::uint64_t>>;

  static bool is_one_cycle(const Fan& fan) {
    std::set<std::uint64_t> seen;
    std::vector<std::uint64_t> open{fan.begin()->first};
    while (!open.empty()) {
      const std::uint64_t at = open.back();
      open.pop_back();
      if (!seen.insert(at).second) continue;
      const auto& next = fan.at(at);
      if (next.size() != 2) return false;
      open.insert(open.end(), next.begin(), next.end());
    }
    return seen.size() == fan.size();
  }

  std::map<Face, std::pair<int, Face>> faces_;
};

PinchedByLabel pinched_by_label(const std::map<Label, Boundary>& boundaries) {
  PinchedByLabel out;
  for (const auto& [label, boundary] : boundaries) out[label] = boundary.pinched();
  return out;
}

}  // namespace

PinchedByLabel pinches_of(const VoxelLabels& volume) {
  std::map<Label, Boundary> boundaries;
  const Box3 voxels{{0, 0, 0}, volume.shape};
  const Box3 corners{{0, 0, 0}, volume.shape + Index3{1, 1, 1}};
  const std::array<Index3, 3> steps{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for_each_index(voxels, [&](Index3 voxel) {
    const Label label = volume.labels[static_cast<std::size_t>(voxels.offset(voxel))];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Index3 u = steps[(axis + 1) % 3], w = steps[(axis + 2) % 3];
      for (const Index3 at : {voxel, voxel + steps[axis]}) {
        Face face;
        for (const Index3 corner : {at, at + u, at + u + w, at + w}) {
          face.push_back(static_cast<std::uint64_t>(corners.offset(corner)));
        }
        boundaries[label].add(face);
      }
    }
  });
  return pinched_by_label(boundaries);
}

PinchedByLabel pinches_of(const AuditMesh& mesh) {
  std::map<Label, Boundary> boundaries;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& [a, b, c, d] = mesh.tets[t];
    for (const Face& face : {Face{b, c, d}, Face{a, c, d}, Face{a, b, d}, Face{a, b, c}}) {
      boundaries[mesh.labels[t]].add(face);
    }
  }
  return pinched_by_label(boundaries);
}

bool is_part_of(const PinchedByLabel& some, const PinchedByLabel& all) {
  return std::all_of(some.begin(), some.end(), [&](const auto& entry) {
    const auto found = all.find(entry.first);
    const Pinched other = found == all.end() ? Pinched{} : found->second;
    return std::ranges::includes(other.vertices, entry.second.vertices) &&
           std::ranges::includes(other.edges, entry.second.edges);
  });
}

}  // namespace mw::audit::test
