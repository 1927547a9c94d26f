// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "io/mesh/grouped/halved_sink.h"

#include <memory>
#include <utility>

#include "kernels/quality/halved_tet.h"

namespace mw::io {
namespace {

constexpr std::size_t kHalvedBatch = 512;  ///< uncut tets whose parts are passed on at once

/// Passes on the eight parts of each tet of a mesh with ten nodes a tet.
class HalvedWriter : public GroupedWriter {
 public:
  HalvedWriter(MeshSink& below, const std::optional<HalvedCurves>& curves,
               std::function<void()> between)
      : below_(below), curves_(curves), between_(std::move(between)) {}

  void write(GroupedMesh& mesh) override {
    MeshHeader header = mesh.header();
    header.tets *= kTetParts.size();
    if (auto& promises = header.record.promises) {
      ++promises->halvings;
      if (curves_) promises->max_distance = curves_->max_distance;
    }
    below_.begin(header);
    write_nodes(mesh, below_);
    for (std::uint64_t tet = 0; tet < mesh.tet_count(); ++tet) {
      add_parts_of(mesh, tet);
      if (rows_.size() >= kHalvedBatch * kTetParts.size()) flush();
    }
    flush();
    below_.finish();
  }

 private:
  void add_parts_of(GroupedMesh& mesh, std::uint64_t tet) {
    const NodeRows rows = mesh.tet_nodes(tet);
    const RawLabel label = mesh.table().raw(mesh.label_of(tet));
    std::array<Vec3, 10> places;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto [x, y, z] = mesh.node(rows.begin()[i]);
      places[i] = {x, y, z};
    }
    for (const auto& [a, b, c, d] : halved_tet(places)) {
      rows_.push_back({rows.begin()[a], rows.begin()[b], rows.begin()[c], rows.begin()[d]});
      labels_.push_back(label);
      for (std::size_t k = 0; k < mesh.header().values.size(); ++k) {
        values_.push_back(mesh.value(tet, k));
      }
    }
  }

  void flush() {
    between_();
    below_.write_tets(rows_, labels_);
    if (!values_.empty()) below_.write_values(values_);
    rows_.clear();
    labels_.clear();
    values_.clear();
  }

  MeshSink& below_;
  std::optional<HalvedCurves> curves_;
  std::function<void()> between_;
  std::vector<TetRows> rows_;
  std::vector<RawLabel> labels_;
  std::vector<double> values_;
};

std::optional<CurveRule> rule_of(const std::optional<HalvedCurves>& curves) {
  if (!curves) return std::nullopt;
  return CurveRule{.has_straight_parts = true, .most_move = curves->most_move};
}

}  // namespace

HalvedSink::HalvedSink(MeshSink& below, const std::filesystem::path& folder,
                       const std::optional<HalvedCurves>& curves, std::function<void()> between)
    : GroupedSink(folder, std::make_unique<HalvedWriter>(below, curves, std::move(between)),
                  Element::kTet10, rule_of(curves)),
      below_(below) {}

std::uint64_t HalvedSink::buffer_bytes() const {
  return GroupedSink::buffer_bytes() + below_.buffer_bytes();
}

}  // namespace mw::io
