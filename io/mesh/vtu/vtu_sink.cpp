// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Streams a mesh into a .vtu file.
#include "io/mesh/vtu/vtu.h"

#include "io/file/byte_order.h"
#include "io/mesh/mesh_sink.h"
#include "kernels/core/assert.h"

namespace mw::io {
namespace {

constexpr std::size_t kRegionBytes = 1 << 18;

}  // namespace

template <class T>
void FileRegion::add(T value) {
  const std::size_t at = buffer_.size();
  buffer_.resize(at + sizeof value);
  store_little(value, buffer_.data() + at);
  if (buffer_.size() >= kRegionBytes) flush();
}

void FileRegion::flush() {
  file_->write_at(next_, buffer_);
  next_ += buffer_.size();
  buffer_.clear();
}

void VtuSink::begin(const MeshHeader& header) {
  header_ = header;
  // Where the numbers of an array start does not depend on how many vertices there will be.
  const VtuLayout layout = make_vtu_layout(header, 0, element_);
  for (std::size_t i = 0; i < layout.arrays; ++i) {
    regions_.emplace_back(file_, layout.start[i] + sizeof(std::uint64_t));
  }
}

void VtuSink::write_vertices(std::span<const Position> positions) {
  FileRegion& points = regions_[VtuLayout::kPoints];
  for (const Position& position : positions) {
    for (const double x : position) points.add(x);
  }
  vertices_ += positions.size();
}

void VtuSink::write_cell(std::span<const std::uint64_t> rows, RawLabel label) {
  for (const std::uint64_t row : rows) regions_[VtuLayout::kConnectivity].add(row);
  corners_ += rows.size();
  regions_[VtuLayout::kOffsets].add(corners_);
  regions_[VtuLayout::kTypes].add(vtk_type(element_));
  regions_[VtuLayout::kLabel].add(label);
  ++tets_;
}

void VtuSink::write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) {
  MW_ASSERT(tets.size() == labels.size() && element_ == Element::kTet4);
  for (std::size_t i = 0; i < tets.size(); ++i) write_cell(tets[i], labels[i]);
}

void VtuSink::write_ten_nodes(std::span<const TenRows> tets, std::span<const RawLabel> labels) {
  MW_ASSERT(tets.size() == labels.size() && element_ == Element::kTet10);
  for (std::size_t i = 0; i < tets.size(); ++i) write_cell(tets[i], labels[i]);
}

void VtuSink::finish() {
  check_sink_counts(name_, header_, tets_);
  for (FileRegion& region : regions_) region.flush();
  const VtuLayout layout = make_vtu_layout(header_, vertices_, element_);
  file_.write_at(0, std::as_bytes(std::span(layout.head)));
  for (std::size_t i = 0; i < layout.arrays; ++i) {
    std::array<std::byte, sizeof(std::uint64_t)> length;
    store_little(layout.length[i], length.data());
    file_.write_at(layout.start[i], length);
  }
  file_.write_at(layout.tail_start, std::as_bytes(std::span(layout.tail)));
  file_.commit();
}

}  // namespace mw::io
