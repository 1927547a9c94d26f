// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The checks of P2, one function each.
#include "kernels/audit/validity.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "kernels/audit/box_planes.h"
#include "kernels/audit/compensated_sum.h"
#include "kernels/audit/mesh_stars.h"
#include "kernels/audit/orientation.h"
#include "kernels/audit/overlap.h"
#include "kernels/core/error.h"

namespace mw::audit {
namespace {

constexpr double kVolumeTolerance = 1e-9;

std::string face_name(const std::array<std::uint32_t, 3>& v) {
  return std::to_string(v[0]) + "-" + std::to_string(v[1]) + "-" + std::to_string(v[2]);
}

class ValidityAudit {
 public:
  ValidityAudit(const AuditMesh& mesh, const VoxelLabels& volume, const Frame& frame,
                std::size_t label_count, const KeptLabels& kept)
      : mesh_(mesh),
        volume_(volume),
        frame_(frame),
        box_(frame, volume.shape),
        label_count_(label_count),
        kept_(kept) {}

  ValidityReport run() {
    const std::optional<MeshStars> stars = check_input();
    if (!stars) return std::move(report_);
    check_orientation();
    check_vertices(*stars);
    check_tets(*stars);
    check_faces(*stars);
    check_box();
    check_volume();
    check_labels();
    if (has_gaps()) report_.checks.push_back(check_overlap(*stars, frame_, volume_.shape));
    return std::move(report_);
  }

 private:
  /// Whether labels were left out.
  [[nodiscard]] bool has_gaps() const { return !kept_.empty(); }

  void conclude(std::string name, bool passed, std::string detail) {
    report_.checks.push_back({"P2 " + std::move(name), passed, std::move(detail)});
  }

  std::optional<MeshStars> check_input() {
    std::optional<MeshStars> stars;
    try {
      stars.emplace(mesh_);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kInput) throw;
      conclude("input", false, error.what());
      return std::nullopt;
    }
    Offenders endless("vertices that are not finite");
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      const Position& p = mesh_.vertices[v];
      if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2])) continue;
      endless.add([v] { return std::to_string(v); });
    }
    const bool sound = endless.count() == 0 && !mesh_.tets.empty();
    conclude("input", sound,
             std::to_string(mesh_.vertices.size()) + " vertices, " +
                 std::to_string(mesh_.tets.size()) + " tets; " + endless.text());
    return sound ? std::move(stars) : std::nullopt;
  }

  /// Fills sign_ with the exact orientation of every tet.
  void check_orientation() {
    sign_.reserve(mesh_.tets.size());
    for (const TetRow& t : mesh_.tets) {
      const auto corner = [&](std::size_t i) -> const Position& { return mesh_.vertices[t[i]]; };
      std::optional<int> sign = filtered_orientation(corner(0), corner(1), corner(2), corner(3));
      if (!sign) {
        ++report_.exact_decisions;
        sign = exact_orientation(corner(0), corner(1), corner(2), corner(3));
      }
      sign_.push_back(static_cast<std::int8_t>(*sign));
      ++tally(*sign);
    }
    conclude_orientation();
  }

  std::uint64_t& tally(int sign) {
    if (sign == 0) return report_.flat_tets;
    return sign > 0 ? report_.positive_tets : report_.negative_tets;
  }

  void conclude_orientation() {
    Offenders wrong("tets that are flat or turned over");
    for (std::size_t t = 0; t < sign_.size(); ++t) {
      if (sign_[t] != 1) wrong.add([t] { return std::to_string(t); });
    }
    if (wrong.count() == 0) report_.orientation = 1;
    if (report_.negative_tets == sign_.size() && !sign_.empty()) report_.orientation = -1;
    conclude("orientation", wrong.count() == 0,
             std::to_string(report_.positive_tets) + " positive, " +
                 std::to_string(report_.negative_tets) + " negative, " +
                 std::to_string(report_.flat_tets) + " flat; " + wrong.text());
  }

  void check_vertices(const MeshStars& stars) {
    struct Placed {
      Position at;
      std::uint32_t vertex;
      auto operator<=>(const Placed&) const = default;
    };
    Offenders unused("vertices in no tet");
    std::vector<Placed> placed(mesh_.vertices.size());
    for (std::uint32_t v = 0; v < stars.vertex_count(); ++v) {
      placed[v] = {mesh_.vertices[v], v};
      if (stars.star(v).empty()) unused.add([v] { return std::to_string(v); });
    }
    report_.unused_vertices = unused.count();
    std::sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) { return a < b; });
    Offenders same("vertices where another one is");
    for (std::size_t i = 1; i < placed.size(); ++i) {
      if (placed[i].at != placed[i - 1].at) continue;
      same.add([&] { return std::to_string(placed[i].vertex); });
    }
    conclude("vertices", same.count() == 0 && unused.count() == 0,
             same.text() + "; " + unused.text());
  }

  void check_tets(const MeshStars& stars) {
    std::vector<std::pair<TetRow, std::uint32_t>> at_smallest;
    Offenders twice("tets that are there twice");
    for (std::uint32_t v = 0; v < stars.vertex_count(); ++v) {
      at_smallest.clear();
      for (const std::uint32_t id : stars.star(v)) {
        TetRow tet = mesh_.tets[id];
        std::sort(tet.begin(), tet.end());
        if (tet[0] == v) at_smallest.emplace_back(tet, id);
      }
      std::sort(at_smallest.begin(), at_smallest.end());
      for (std::size_t i = 1; i < at_smallest.size(); ++i) {
        if (at_smallest[i].first != at_smallest[i - 1].first) continue;
        twice.add([&] { return std::to_string(at_smallest[i].second); });
      }
    }
    conclude("tets", twice.count() == 0, twice.text());
  }

  void check_faces(const MeshStars& stars) {
    Offenders open("triangles of one tet that are not on the box");
    Offenders crowded("triangles of three or more tets");
    Offenders folded("triangles with both tets on one side");
    visit_faces(stars, [&](const MeshFace& face) {
      ++report_.faces;
      const auto name = [&] { return face_name(face.vertices); };
      if (face.sides.size() > 2) crowded.add(name);
      if (face.sides.size() == 2 && !on_opposite_sides(face)) folded.add(name);
      if (face.sides.size() != 1) return;
      ++report_.box_faces;
      if (!has_gaps() && !on_box(face)) open.add(name);
    });
    conclude("faces", open.count() + crowded.count() + folded.count() == 0,
             std::to_string(report_.faces) + " triangles, " + std::to_string(report_.box_faces) +
                 " of one tet; " + open.text() + ", " + crowded.text() + ", " + folded.text());
  }

  /// Where a tet lies is its orientation times the parity with which it names the triangle.  Flat
  /// tets lie on no side; orientation has failed then.
  [[nodiscard]] bool on_opposite_sides(const MeshFace& face) const {
    const auto side = [&](const FaceSide& s) { return s.odd ? -sign_[s.tet] : +sign_[s.tet]; };
    const int product = side(face.sides[0]) * side(face.sides[1]);
    return product <= 0;
  }

  [[nodiscard]] bool on_box(const MeshFace& face) const {
    return box_.share_plane({&mesh_.vertices[face.vertices[0]], &mesh_.vertices[face.vertices[1]],
                             &mesh_.vertices[face.vertices[2]]});
  }

  void check_box() {
    Offenders outside("vertices outside the box");
    std::array<bool, 8> found{};
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      if (!box_.contains(mesh_.vertices[v])) outside.add([v] { return std::to_string(v); });
      if (const auto corner = box_.corner_at(mesh_.vertices[v])) found[*corner] = true;
    }
    const auto corners = std::count(found.begin(), found.end(), true);
    conclude("box", outside.count() == 0 && (corners == 8 || has_gaps()),
             outside.text() + "; " + std::to_string(corners) + " of 8 corners");
  }

  void check_volume() {
    std::vector<CompensatedSum> sums(label_count_ + 1);
    CompensatedSum all;
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
      const double volume = std::abs(volume_of(mesh_.tets[t]));
      sums[std::min<std::size_t>(mesh_.labels[t], label_count_)].add(volume);
      all.add(volume);
    }
    for (const CompensatedSum& sum : sums) report_.label_volumes.push_back(sum.value());
    report_.volume = all.value();
    report_.box_volume = box_.volume();
    const double excess = report_.volume - report_.box_volume;
    const double error = has_gaps() ? excess : std::abs(excess);
    conclude("volume", error <= kVolumeTolerance * report_.box_volume + box_.volume_rounding(),
             "tets " + number(report_.volume) + ", box " + number(report_.box_volume));
  }

  [[nodiscard]] double volume_of(const TetRow& t) const {
    const Position& a = mesh_.vertices[t[0]];
    std::array<Position, 3> r{};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) r[i][k] = mesh_.vertices[t[i + 1]][k] - a[k];
    }
    return (r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) +
            r[0][1] * (r[1][2] * r[2][0] - r[1][0] * r[2][2]) +
            r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0])) /
           6;
  }

  void check_labels() {
    std::vector<bool> in_volume(label_count_ + 1, false);
    std::vector<bool> in_mesh(label_count_ + 1, false);
    for (const Label l : volume_.labels) {
      if (keeps(kept_, l)) in_volume[std::min<std::size_t>(l, label_count_)] = true;
    }
    Offenders strange(has_gaps() ? "tets whose label is not one of those kept"
                                 : "tets whose label is not in the volume");
    for (std::size_t t = 0; t < mesh_.labels.size(); ++t) {
      const auto label = std::min<std::size_t>(mesh_.labels[t], label_count_);
      in_mesh[label] = true;
      if (label == label_count_ || !in_volume[label]) {
        strange.add([t] { return std::to_string(t); });
      }
    }
    Offenders lost(has_gaps() ? "labels that are kept and not in the mesh"
                              : "labels of the volume that are not in the mesh");
    for (std::size_t l = 0; l < label_count_; ++l) {
      if (in_volume[l] && !in_mesh[l]) lost.add([l] { return "dense " + std::to_string(l); });
    }
    conclude("labels", strange.count() + lost.count() == 0, strange.text() + ", " + lost.text());
  }

  const AuditMesh& mesh_;
  const VoxelLabels& volume_;
  Frame frame_;
  BoxPlanes box_;
  std::size_t label_count_;
  const KeptLabels& kept_;
  ValidityReport report_;
  std::vector<std::int8_t> sign_;
};

}  // namespace

bool ValidityReport::passed() const {
  return std::all_of(checks.begin(), checks.end(), [](const Check& c) { return c.passed; });
}

ValidityReport check_validity(const AuditMesh& mesh, const VoxelLabels& volume, const Frame& frame,
                              std::size_t label_count, const KeptLabels& kept) {
  return ValidityAudit(mesh, volume, frame, label_count, kept).run();
}

}  // namespace mw::audit
