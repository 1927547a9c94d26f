// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "io/mesh/grouped/halved_mesh.h"

#include <vector>

#include "io/mesh/grouped/grouped_sink.h"
#include "kernels/quality/halved_tet.h"

namespace mw::io {
namespace {

constexpr std::size_t kHalvedBatch = 512;  ///< uncut tets whose parts are passed on at once

/// Passes on the eight parts of each tet of a mesh with ten nodes a tet.
class HalvedTets {
 public:
  HalvedTets(GroupedMesh& mesh, MeshSink& below) : mesh_(mesh), below_(below) {}

  void write(const std::function<void()>& between) {
    for (std::uint64_t tet = 0; tet < mesh_.tet_count(); ++tet) {
      add_parts_of(tet);
      if (rows_.size() < kHalvedBatch * kTetParts.size()) continue;
      between();
      flush();
    }
    flush();
  }

 private:
  void add_parts_of(std::uint64_t tet) {
    const NodeRows rows = mesh_.tet_nodes(tet);
    const RawLabel label = mesh_.table().raw(mesh_.label_of(tet));
    std::array<Vec3, 10> places;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto [x, y, z] = mesh_.node(rows.begin()[i]);
      places[i] = {x, y, z};
    }
    for (const auto& [a, b, c, d] : halved_tet(places)) {
      rows_.push_back({rows.begin()[a], rows.begin()[b], rows.begin()[c], rows.begin()[d]});
      labels_.push_back(label);
      for (std::size_t k = 0; k < mesh_.header().values.size(); ++k) {
        values_.push_back(mesh_.value(tet, k));
      }
    }
  }

  void flush() {
    below_.write_tets(rows_, labels_);
    if (!values_.empty()) below_.write_values(values_);
    rows_.clear();
    labels_.clear();
    values_.clear();
  }

  GroupedMesh& mesh_;
  MeshSink& below_;
  std::vector<TetRows> rows_;
  std::vector<RawLabel> labels_;
  std::vector<double> values_;
};

std::optional<CurveRule> rule_of(const std::optional<HalvedCurves>& curves) {
  if (!curves) return std::nullopt;
  return CurveRule{.has_straight_parts = true, .most_move = curves->most_move};
}

}  // namespace

void halve(ScratchMesh& mesh, MeshSink& below, const std::optional<HalvedCurves>& curves,
           const std::function<void()>& between) {
  GroupedSink sink(mesh.folder(), nullptr, Element::kTet10, rule_of(curves));
  GroupedMesh& grouped = sink.view(mesh, between);
  MeshHeader header = grouped.header();
  header.tets *= kTetParts.size();
  if (auto& promises = header.record.promises) {
    ++promises->halvings;
    if (curves) promises->max_distance = curves->max_distance;
  }
  below.begin(header);
  write_nodes(grouped, below);
  HalvedTets(grouped, below).write(between);
  below.finish();
}

}  // namespace mw::io
