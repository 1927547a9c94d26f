// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Streams a mesh into a .vtkhdf file.
#include "io/mesh/vtkhdf/vtkhdf_sink.h"

#include "io/mesh/sink_counts.h"
#include "kernels/core/assert.h"

namespace mw::io {

void VtkhdfSink::begin(const MeshHeader& header) {
  header_ = header;
  places_ = place_vtkhdf(output_.rooms(), element_, header.tets);
  columns_ = VtkhdfColumns(output_, places_, element_);
  columns_.go_to({0, 0});
}

void VtkhdfSink::write_vertices(std::span<const Position> positions) {
  columns_.write_vertices(positions);
}

/// Rows beyond those that were announced would be written over others.
bool VtkhdfSink::has_room(std::size_t tets) const {
  return columns_.place().tet + tets <= header_.tets;
}

void VtkhdfSink::write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) {
  MW_ASSERT(tets.size() == labels.size() && has_room(tets.size()));
  columns_.write_tets(tets, labels);
}

void VtkhdfSink::write_ten_nodes(std::span<const TenRows> tets, std::span<const RawLabel> labels) {
  MW_ASSERT(tets.size() == labels.size() && has_room(tets.size()));
  MW_ASSERT(element_ == Element::kTet10);
  for (std::size_t i = 0; i < tets.size(); ++i) columns_.write_cell(tets[i], labels[i]);
}

void VtkhdfSink::finish() {
  check_sink_counts(output_.name(), header_, columns_.place().tet);
  columns_.flush();
  const std::uint64_t vertices = columns_.place().vertex;
  static_cast<void>(output_.reserve(vertices * sizeof(Position)));
  commit_vtkhdf(output_, places_, element_, header_, vertices);
}

}  // namespace mw::io
