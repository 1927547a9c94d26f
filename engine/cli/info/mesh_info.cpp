// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A mesh and its volume side by side.
#include "engine/cli/info/mesh_info.h"

#include <algorithm>
#include <limits>
#include <memory>

#include "engine/labels/label_regions.h"
#include "engine/labels/label_scan.h"
#include "engine/labels/shared_reads.h"

namespace mw::cli {

VolumeSide look_at_volume(const VolumeRequest& request, bool with_areas) {
  const std::unique_ptr<io::LabelVolume> opened = open(request);
  engine::SharedReads shared(*opened);
  const io::PreparedInput input(shared, request.steps);
  shared.end();
  const io::VolumeInfo& info = input.volume().info();
  VolumeSide out{.voxels = {}, .unit = info.space.unit, .names = info.names, .areas = {}};
  for (const engine::LabelRegion& region : engine::label_regions(input.volume())) {
    out.voxels.emplace(region.label, region.voxels);
  }
  const auto& edge = info.space.spacing;
  for (const double length : edge) out.voxel_volume *= length;
  if (!with_areas) return out;
  constexpr auto kMuch = std::numeric_limits<std::uint64_t>::max();
  const int readers = engine::scanner_count(input.volume(), 1, kMuch);
  for (const engine::LabelContact& c : engine::label_contacts(input.volume(), readers)) {
    double area = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      area += static_cast<double>(c.faces[k]) * edge[(k + 1) % 3] * edge[(k + 2) % 3];
    }
    out.areas[{c.first, c.second}] = area;
  }
  return out;
}

std::vector<Contact> contacts_of(const MeshInfo& facts) {
  std::vector<Contact> out;
  auto unmet = facts.volume ? facts.volume->areas : decltype(facts.volume->areas)();
  for (const ContactStats& c : facts.mesh.contacts) {
    Contact contact{facts.table.raw(c.first), facts.table.raw(c.second), c.triangles, c.area, {}};
    const auto found = unmet.find(std::minmax(contact.first, contact.second));
    if (facts.volume) contact.voxel_area = found == unmet.end() ? 0 : found->second;
    if (found != unmet.end()) unmet.erase(found);
    out.push_back(contact);
  }
  for (const auto& [pair, area] : unmet) {
    const bool in_mesh = facts.table.contains(pair.first) && facts.table.contains(pair.second);
    if (in_mesh) out.push_back({pair.first, pair.second, 0, 0, area});
  }
  return out;
}

std::optional<audit::VolumeRow> voxels_of(const MeshInfo& facts, Label rank) {
  if (!facts.volume) return std::nullopt;
  const auto found = facts.volume->voxels.find(facts.table.raw(rank));
  if (found == facts.volume->voxels.end()) return std::nullopt;
  const auto voxels = static_cast<double>(found->second);
  const double in_mesh = facts.mesh.labels[rank].volume / facts.volume->voxel_volume;
  return audit::VolumeRow{rank, found->second, in_mesh, (in_mesh - voxels) / voxels};
}

}  // namespace mw::cli
