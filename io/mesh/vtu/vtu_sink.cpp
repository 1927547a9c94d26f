// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Streams a mesh into a .vtu file.
#include "io/mesh/vtu/vtu.h"

#include "io/file/byte_order.h"
#include "io/mesh/mesh_sink.h"

namespace mw::io {

void VtuSink::begin(const MeshHeader& header) {
  // Where the numbers of an array start does not depend on how many vertices there will be.
  const VtuLayout layout = make_vtu_layout(header, 0, element());
  const auto numbers = [&](VtuLayout::Array array) {
    return layout.start[array] + sizeof(std::uint64_t);
  };
  std::vector<std::uint64_t> values = layout.values;
  for (std::uint64_t& start : values) start += sizeof(std::uint64_t);
  std::vector<std::uint64_t> masks = layout.masks;
  for (std::uint64_t& start : masks) start += sizeof(std::uint64_t);
  // The first offset, which this format does not have, goes where the count of bytes will be.
  place_columns(header, file_,
                {.connectivity = numbers(VtuLayout::kConnectivity),
                 .offsets = layout.start[VtuLayout::kOffsets],
                 .types = numbers(VtuLayout::kTypes),
                 .labels = numbers(VtuLayout::kLabel),
                 .points = numbers(VtuLayout::kPoints),
                 .values = std::move(values),
                 .cohesive = layout.cohesive.value_or(0) + sizeof(std::uint64_t),
                 .masks = std::move(masks)});
}

void VtuSink::finish() {
  const std::uint64_t vertices = finish_columns(name_).vertex;
  const VtuLayout layout = make_vtu_layout(header(), vertices, element());
  file_.write_at(0, std::as_bytes(std::span(layout.head)));
  const auto put_length = [&](std::uint64_t start, std::uint64_t bytes) {
    std::array<std::byte, sizeof(std::uint64_t)> length;
    store_little(bytes, length.data());
    file_.write_at(start, length);
  };
  for (std::size_t i = 0; i < layout.arrays; ++i) put_length(layout.start[i], layout.length[i]);
  for (const std::uint64_t start : layout.values) put_length(start, layout.value_length);
  for (const std::uint64_t start : layout.masks) put_length(start, layout.mask_length);
  if (layout.cohesive) put_length(*layout.cohesive, layout.value_length);
  file_.write_at(layout.tail_start, std::as_bytes(std::span(layout.tail)));
  file_.commit();
}

}  // namespace mw::io
