// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A stream of tets becomes a grouped mesh.
#include "io/mesh/grouped/grouped_sink.h"

#include "io/mesh/grouped/mesh_grouping.h"

namespace mw::io {

GroupedSink::GroupedSink(const std::filesystem::path& folder, std::unique_ptr<GroupedWriter> writer,
                         Element element)
    : grouping_(std::make_unique<MeshGrouping>(folder, element)),
      writer_(std::move(writer)),
      element_(element) {}

GroupedSink::~GroupedSink() = default;

void GroupedSink::begin(const MeshHeader& header) {
  grouping_->begin(header);
}

void GroupedSink::write_vertices(std::span<const Position> positions) {
  grouping_->add_vertices(positions);
}

void GroupedSink::write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) {
  grouping_->add_tets(tets, labels);
}

void GroupedSink::finish() {
  grouping_->group();
  if (writer_) writer_->write(grouping_->mesh());
}

std::uint64_t GroupedSink::buffer_bytes() const {
  constexpr std::uint64_t kOfCorners = 64 << 20;
  constexpr std::uint64_t kOfMiddles = 32 << 20;
  return element_ == Element::kTet10 ? kOfCorners + kOfMiddles : kOfCorners;
}

GroupedMesh& GroupedSink::mesh() {
  return grouping_->mesh();
}

}  // namespace mw::io
