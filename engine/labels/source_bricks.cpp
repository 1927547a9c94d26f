// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// In the file a brick is its box, two counts, the faces of its voxels, and its planes.
#include "engine/labels/source_bricks.h"

namespace mw::engine {
namespace {

struct Head {
  Box3 box;
  std::uint64_t voxels = 0;
  std::uint64_t planes = 0;
};

}  // namespace

SourceBricks::SourceBricks(Index3 bricks, const std::filesystem::path& folder,
                           const PlaneForm& form)
    : bricks_(bricks),
      form_(form),
      offsets_(static_cast<std::size_t>(bricks.product()), kNoFaces),
      file_(folder) {}

void SourceBricks::write(Index3 brick, const SourceSurface& surface, const Box3& voxels) {
  const SourceSurface::Part part = surface.part(voxels);
  if (part.planes.empty()) return;
  const Head head{part.box, part.faces.size(), part.planes.size()};
  const auto as_bytes = [](const auto& values) { return std::as_bytes(std::span(values)); };
  std::vector<std::byte> bytes;
  const auto append = [&bytes](std::span<const std::byte> more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
  };
  append(std::as_bytes(std::span(&head, 1)));
  append(as_bytes(part.faces));
  append(as_bytes(part.planes));
  const std::uint64_t offset = file_size_.fetch_add(bytes.size(), std::memory_order_relaxed);
  file_.write_at(offset, bytes);
  const Box3 all{{0, 0, 0}, bricks_};
  offsets_[static_cast<std::size_t>(all.offset(brick))] = offset;
}

SourceSurface::Part SourceBricks::part(std::uint64_t offset) const {
  Head head;
  file_.read_at(offset, std::as_writable_bytes(std::span(&head, 1)));
  SourceSurface::Part out{.box = head.box,
                          .faces = std::vector<UpperFaces>(head.voxels),
                          .planes = std::vector<PackedPlane>(head.planes)};
  offset += sizeof(Head);
  file_.read_at(offset, std::as_writable_bytes(std::span(out.faces)));
  file_.read_at(offset + head.voxels, std::as_writable_bytes(std::span(out.planes)));
  return out;
}

SourceSurface SourceBricks::read(const Box3& box) const {
  constexpr std::int64_t kEdge = io::BrickVolume::kEdge;
  const Box3 all{{0, 0, 0}, bricks_};
  const Box3 bricks = cells_of(box, {kEdge, kEdge, kEdge});
  return {box,
          [&](auto visit) {
            for_each_index(bricks, [&](Index3 brick) {
              const std::uint64_t offset = offsets_[static_cast<std::size_t>(all.offset(brick))];
              if (offset != kNoFaces) visit(part(offset));
            });
          },
          form_};
}

}  // namespace mw::engine
