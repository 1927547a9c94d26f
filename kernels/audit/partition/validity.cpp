// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The checks of P2, one function each.
#include "kernels/audit/partition/validity.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "kernels/audit/partition/box_planes.h"
#include "kernels/audit/partition/orientation.h"
#include "kernels/core/vector3.h"

namespace mw::audit {
namespace {

constexpr double kVolumeTolerance = 1e-9;

class TileAudit {
 public:
  TileAudit(const MeshStars& stars, const ValidityTask& task)
      : stars_(stars), task_(task), box_(task.frame, task.shape) {
    tally_.in_mesh.resize(task.wanted.size() + 1);
  }

  ValidityTally run() {
    take_orientations();
    check_vertices();
    check_tets();
    check_faces();
    check_box();
    measure_labels();
    return std::move(tally_);
  }

 private:
  [[nodiscard]] const AuditMesh& mesh() const { return stars_.mesh(); }
  [[nodiscard]] const MeshTile& tile() const { return stars_.tile(); }
  [[nodiscard]] std::string tet_name(std::size_t tet) const {
    return std::to_string(tile().tet_id(tet));
  }
  [[nodiscard]] std::string vertex_name(std::uint64_t vertex) const {
    return std::to_string(tile().vertex_id(vertex));
  }

  /// Fills sign_ with the exact orientation of every tet.
  void take_orientations() {
    sign_.reserve(mesh().tets.size());
    for (std::size_t t = 0; t < mesh().tets.size(); ++t) {
      const TetRow& row = mesh().tets[t];
      const auto corner = [&](std::size_t i) -> const Position& { return mesh().vertices[row[i]]; };
      std::optional<int> sign = filtered_orientation(corner(0), corner(1), corner(2), corner(3));
      if (!sign) sign = exact_orientation(corner(0), corner(1), corner(2), corner(3));
      sign_.push_back(static_cast<std::int8_t>(*sign));
      if (!tile().owns_tet(t)) continue;
      ++count_of(*sign);
      if (*sign != 1) tally_.turned.add([&] { return tet_name(t); });
    }
  }

  std::uint64_t& count_of(int sign) {
    if (sign == 0) return tally_.flat_tets;
    return sign > 0 ? tally_.positive_tets : tally_.negative_tets;
  }

  /// One tile owns all vertices at one position, so each tile compares only its own.
  void check_vertices() {
    struct Placed {
      Position at;
      std::uint32_t vertex;
      auto operator<=>(const Placed&) const = default;
    };
    std::vector<Placed> placed;
    for (std::uint32_t v = 0; v < stars_.vertex_count(); ++v) {
      if (!stars_.owns(v)) continue;
      placed.push_back({mesh().vertices[v], v});
      if (stars_.star(v).empty()) tally_.unused.add([&] { return vertex_name(v); });
    }
    std::sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) { return a < b; });
    for (std::size_t i = 1; i < placed.size(); ++i) {
      if (placed[i].at != placed[i - 1].at) continue;
      tally_.same.add([&] { return vertex_name(placed[i].vertex); });
    }
  }

  void check_tets() {
    std::vector<std::pair<TetRow, std::uint32_t>> at_smallest;
    for (std::uint32_t v = 0; v < stars_.vertex_count(); ++v) {
      if (!stars_.owns(v)) continue;
      at_smallest.clear();
      for (const std::uint32_t id : stars_.star(v)) {
        TetRow tet = mesh().tets[id];
        std::sort(tet.begin(), tet.end());
        if (tet[0] == v) at_smallest.emplace_back(tet, id);
      }
      std::sort(at_smallest.begin(), at_smallest.end());
      for (std::size_t i = 1; i < at_smallest.size(); ++i) {
        if (at_smallest[i].first != at_smallest[i - 1].first) continue;
        tally_.twice.add([&] { return tet_name(at_smallest[i].second); });
      }
    }
  }

  void check_faces() {
    for_each_face(stars_, [&](const MeshFace& face) {
      ++tally_.faces;
      const auto name = [&] {
        return vertex_name(face.vertices[0]) + "-" + vertex_name(face.vertices[1]) + "-" +
               vertex_name(face.vertices[2]);
      };
      if (face.sides.size() > 2) tally_.crowded.add(name);
      if (face.sides.size() == 2 && !on_opposite_sides(face)) tally_.folded.add(name);
      if (face.sides.size() != 1) return;
      ++tally_.box_faces;
      if (!task_.has_gaps && !on_box(face)) tally_.open.add(name);
    });
  }

  /// The side of a tet is its orientation times the parity with which it names the triangle.  Flat
  /// tets lie on no side, but with them the check of orientation fails.
  [[nodiscard]] bool on_opposite_sides(const MeshFace& face) const {
    const auto side = [&](const FaceSide& s) { return s.odd ? -sign_[s.tet] : +sign_[s.tet]; };
    const int product = side(face.sides[0]) * side(face.sides[1]);
    return product <= 0;
  }

  [[nodiscard]] bool on_box(const MeshFace& face) const {
    const auto& at = mesh().vertices;
    return box_.share_plane({&at[face.vertices[0]], &at[face.vertices[1]], &at[face.vertices[2]]});
  }

  void check_box() {
    for (std::uint32_t v = 0; v < stars_.vertex_count(); ++v) {
      if (!stars_.owns(v)) continue;
      const Position& p = mesh().vertices[v];
      if (!box_.contains(p)) tally_.outside.add([&] { return vertex_name(v); });
      if (const auto corner = box_.corner_at(p)) tally_.corners[*corner] = true;
    }
  }

  void measure_labels() {
    const auto& at = mesh().vertices;
    const std::size_t unknown = task_.wanted.size();
    for (std::size_t t = 0; t < mesh().tets.size(); ++t) {
      if (!tile().owns_tet(t)) continue;
      const auto& [a, b, c, d] = mesh().tets[t];
      const std::size_t label = std::min<std::size_t>(mesh().labels[t], unknown);
      tally_.volume.add(std::abs(volume6(at[a], at[b], at[c], at[d]) / 6));
      tally_.in_mesh[label] = true;
      if (label == unknown || !task_.wanted[label]) tally_.strange.add([&] { return tet_name(t); });
    }
  }

  const MeshStars& stars_;
  const ValidityTask& task_;
  BoxPlanes box_;
  ValidityTally tally_;
  std::vector<std::int8_t> sign_;
};

/// Puts the verdict into words.
class Judgement {
 public:
  Judgement(const ValidityTally& tally, const ValidityTask& task)
      : tally_(tally), task_(task), box_(task.frame, task.shape) {}

  ValidityReport run() {
    report_.volume = tally_.volume.value();
    report_.box_volume = box_.volume();
    judge_orientation();
    conclude("vertices", {&tally_.same, &tally_.unused}, "", "; ");
    conclude("tets", {&tally_.twice}, "", "");
    conclude("faces", {&tally_.open, &tally_.crowded, &tally_.folded},
             std::to_string(tally_.faces) + " triangles, " + std::to_string(tally_.box_faces) +
                 " of one tet; ",
             ", ");
    judge_box();
    judge_volume();
    judge_labels();
    return std::move(report_);
  }

 private:
  void add(const char* name, bool passed, std::string detail) {
    report_.checks.push_back({std::string("P2 ") + name, passed, std::move(detail)});
  }

  void conclude(const char* name, std::initializer_list<const Offenders*> offenders,
                std::string detail, const char* separator) {
    bool passed = true;
    for (const Offenders* o : offenders) {
      passed = passed && o->count() == 0;
      detail += (o == *offenders.begin() ? "" : separator) + o->text();
    }
    add(name, passed, std::move(detail));
  }

  void judge_orientation() {
    conclude("orientation", {&tally_.turned},
             std::to_string(tally_.positive_tets) + " positive, " +
                 std::to_string(tally_.negative_tets) + " negative, " +
                 std::to_string(tally_.flat_tets) + " flat; ",
             "");
  }

  void judge_box() {
    const auto corners = std::count(tally_.corners.begin(), tally_.corners.end(), true);
    add("box", tally_.outside.count() == 0 && (corners == 8 || task_.has_gaps),
        tally_.outside.text() + "; " + std::to_string(corners) + " of 8 corners");
  }

  void judge_volume() {
    const double excess = report_.volume - report_.box_volume;
    const double error = task_.has_gaps ? excess : std::abs(excess);
    add("volume", error <= kVolumeTolerance * report_.box_volume + box_.volume_rounding(),
        "tets " + number(report_.volume) + ", box " + number(report_.box_volume) + ", difference " +
            number(excess));
  }

  void judge_labels() {
    Offenders strange(task_.has_gaps ? "tets whose label is not one of those kept"
                                     : "tets whose label is not in the volume");
    strange.add(tally_.strange);
    Offenders lost(task_.has_gaps ? "labels that are kept and not in the mesh"
                                  : "labels of the volume that are not in the mesh");
    for (std::size_t l = 0; l < task_.wanted.size(); ++l) {
      if (task_.wanted[l] && !tally_.in_mesh[l]) {
        lost.add([&] { return label_text(static_cast<Label>(l), task_.label_text); });
      }
    }
    conclude("labels", {&strange, &lost}, "", ", ");
  }

  const ValidityTally& tally_;
  const ValidityTask& task_;
  BoxPlanes box_;
  ValidityReport report_;
};

}  // namespace

void ValidityTally::add(const ValidityTally& other, std::span<const Label> labels) {
  const std::pair<Offenders&, const Offenders&> offenders[] = {
      {turned, other.turned}, {unused, other.unused},   {same, other.same},
      {twice, other.twice},   {open, other.open},       {crowded, other.crowded},
      {folded, other.folded}, {outside, other.outside}, {strange, other.strange}};
  for (const auto& [mine, its] : offenders) mine.add(its);
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = corners[i] || other.corners[i];
  positive_tets += other.positive_tets;
  negative_tets += other.negative_tets;
  flat_tets += other.flat_tets;
  faces += other.faces;
  box_faces += other.box_faces;
  volume.add(other.volume);
  for (std::size_t l = 0; l < other.in_mesh.size(); ++l) {
    const std::size_t row = l < labels.size() ? labels[l] : in_mesh.size() - 1;
    in_mesh[row] = in_mesh[row] || other.in_mesh[l];
  }
}

ValidityTally tally_validity(const MeshStars& stars, const ValidityTask& task) {
  return TileAudit(stars, task).run();
}

ValidityReport judge_validity(const ValidityTally& tally, const ValidityTask& task) {
  return Judgement(tally, task).run();
}

Check input_check(std::uint64_t vertices, std::uint64_t tets, const Offenders& endless) {
  return {
      "P2 input", endless.count() == 0 && tets > 0,
      std::to_string(vertices) + " vertices, " + std::to_string(tets) + " tets; " + endless.text()};
}

bool ValidityReport::passed() const {
  return std::all_of(checks.begin(), checks.end(), [](const Check& c) { return c.passed; });
}

}  // namespace mw::audit
