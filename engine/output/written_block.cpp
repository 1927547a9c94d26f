// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/output/written_block.h"

#include <utility>

namespace mw::engine {
namespace {

/// Returns the names of the labels that are written.
io::LabelNames written_names(const io::DenseVolume& volume, const LabelSelection& selection) {
  const io::LabelTable& table = volume.table();
  return volume.info().names.only(
      [&](RawLabel label) { return table.contains(label) && selection.keeps(table.dense(label)); });
}

/// Returns the masks by those of their labels that are written.
std::vector<io::MaskLabels> written_masks(const io::DenseVolume& volume,
                                          const LabelSelection& selection) {
  const io::LabelTable& table = volume.table();
  return io::only_masks(volume.info().masks, [&](RawLabel label) {
    return table.contains(label) && selection.keeps(table.dense(label));
  });
}

io::MeshBox box_of(const io::VolumeInfo& info) {
  const io::Vector3 extent{static_cast<double>(info.shape.x), static_cast<double>(info.shape.y),
                           static_cast<double>(info.shape.z)};
  io::MeshBox box{.origin = to_world(info.space, {0, 0, 0})};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      box.edges[i][k] = info.space.spacing[i] * extent[i] * info.space.axes[i][k];
    }
  }
  return box;
}

/// Records the written or the left-out labels, whichever list is shorter.
void tell_choice(const LabelSelection& selection, const io::LabelTable& table,
                 io::MeshRecord& record) {
  std::vector<RawLabel> only, without;
  for (Label l = 0; l < table.size(); ++l) {
    (selection.keeps(l) ? only : without).push_back(table.raw(l));
  }
  if (without.size() <= only.size()) {
    record.without_labels = std::move(without);
  } else {
    record.only_labels = std::move(only);
  }
}

std::vector<io::Position> positions_of(const BlockMesh& block, const io::VolumeInfo& info,
                                       Index3 layers) {
  std::vector<io::Position> out;
  out.reserve(block.vertices.size());
  for (const BlockVertex& v : block.vertices) {
    out.push_back(physical(v.position, info.space, layers));
  }
  return out;
}

std::vector<io::TetRows> oriented_tets(const BlockMesh& block, bool mirrored) {
  std::vector<io::TetRows> out;
  out.reserve(block.tets.size());
  const auto at = [&](std::uint32_t v) { return block.vertices[v].position; };
  for (const BlockTet& t : block.tets) {
    auto [a, b, c, d] = t.vertices;
    if ((volume6(at(a), at(b), at(c), at(d)) < 0) != mirrored) std::swap(c, d);
    out.push_back({a, b, c, d});
  }
  return out;
}

std::vector<RawLabel> raw_labels(const BlockMesh& block, const io::LabelTable& table) {
  std::vector<RawLabel> out;
  out.reserve(block.tets.size());
  for (const BlockTet& t : block.tets) out.push_back(table.raw(t.label));
  return out;
}

}  // namespace

WrittenBlock written_block(BlockMesh block, const io::DenseVolume& volume, Index3 layers) {
  WrittenBlock out{.block = std::move(block)};
  out.positions = positions_of(out.block, volume.info(), layers);
  out.tets = oriented_tets(out.block, is_mirrored(volume.info().space));
  out.labels = raw_labels(out.block, volume.table());
  return out;
}

void give_rows(std::vector<io::TetRows>& tets, std::span<const std::uint64_t> rows) {
  for (io::TetRows& tet : tets) {
    for (std::uint64_t& v : tet) v = rows[v];
  }
}

io::MeshHeader header_of(const io::DenseVolume& volume, const LabelSelection& selection,
                         std::uint64_t tets, const std::optional<io::MeshPromises>& promises) {
  const io::VolumeSpace& space = volume.info().space;
  io::MeshHeader out{.tets = tets,
                     .labels_signed = volume.table().is_signed(),
                     .names = written_names(volume, selection),
                     .record = {.box = box_of(volume.info()),
                                .promises = promises,
                                .frame = space.frame,
                                .unit = io::nm_in(space.unit) ? space.unit : std::string(),
                                .masks = written_masks(volume, selection)}};
  tell_choice(selection, volume.table(), out.record);
  return out;
}

}  // namespace mw::engine
