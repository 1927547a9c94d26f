// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sorts vertices into tiles by where they lie, and tets by their vertices.
#include "engine/verify/mesh_tiles.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "io/volume/volume_space.h"
#include "kernels/audit/partition/validity.h"
#include "kernels/audit/shape/volumes.h"
#include "kernels/core/error.h"
#include "kernels/core/lattice.h"
#include "kernels/core/sort_distinct.h"
#include "kernels/core/tet_nodes.h"

namespace mw::engine {
namespace {

/// True if the corner's place in the world is p up to rounding.
bool is_position_of(const io::VolumeSpace& space, const Vector3& corner, const io::Position& p) {
  constexpr double kUnitsInLastPlace = 10;
  constexpr double kRounding = kUnitsInLastPlace * std::numeric_limits<double>::epsilon();
  const Vector3 position = io::to_world(space, corner);
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    largest =
        std::max({largest, std::abs(space.origin[i]), space.spacing[i] * std::abs(corner[i])});
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(std::abs(position[k] - p[k]) <= kRounding * largest)) return false;
  }
  return true;
}

Vector3 nearest_lattice_point(const Vector3& corner, Index3 layers) {
  const auto nearest = [](double x, std::int64_t parts) {
    const auto units = static_cast<double>(parts * kUnitsPerVoxel);
    return std::nearbyint(x * units) / units;
  };
  return {nearest(corner[0], layers.x), nearest(corner[1], layers.y), nearest(corner[2], layers.z)};
}

/// Undoes the space of a volume for a vertex, and returns spacing * corner.  (Where the world sees
/// the array in a mirror, the caller swaps two corners of each tet, so that positive tets stay so.)
/// A vertex that was written from a point of the lattice (1/1024 of a voxel that is cut into
/// `layers`) comes back as that point exactly: it is taken for one when the point's place in the
/// world is the vertex to within rounding, some 10 units in the last place of the largest number
/// that its coordinate is the sum of.  Other vertices come back as the rounded inverse has them.
io::Position array_position(const io::VolumeSpace& space, const io::Position& p, Index3 layers) {
  const Vector3 corner = io::to_corner(space, p);
  const Vector3 point = nearest_lattice_point(corner, layers);
  const Vector3& found = is_position_of(space, point, p) ? point : corner;
  io::Position out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = space.spacing[i] * found[i];
  return out;
}

}  // namespace

MeshTiles::MeshTiles(const io::VolumeInfo& volume, const io::LabelTable& table,
                     const Place& junction)
    : volume_(volume),
      table_(table),
      layers_(layers_of(volume.space.spacing)),
      is_upright_(io::is_upright(volume.space)),
      is_mirrored_(io::is_mirrored(volume.space)),
      grid_(volume.shape, layers_, junction.edge),
      memory_bytes_(junction.memory_bytes),
      positions_(junction.folder),
      labels_(table.size()),
      tets_(junction.folder, grid_.size(), junction.memory_bytes),
      curved_tets_(junction.folder),
      beyond_parts_(table.size()) {}

void MeshTiles::begin(const io::MeshHeader& header) {
  header_ = header;
  const std::optional<io::MeshPromises>& promises = header.record.promises;
  layers_ = layers_of(volume_.space.spacing, volume_.shape, promises ? promises->periodic : 0);
  if (header.in_parts) curved_.emplace();
}

audit::Frame MeshTiles::frame() const {
  if (!is_upright_) return {.spacing = volume_.space.spacing, .origin = {}};
  return {.spacing = volume_.space.spacing, .origin = volume_.space.origin};
}

audit::Position MeshTiles::in_array(const io::Position& p) const {
  return is_upright_ ? p : array_position(volume_.space, p, layers_);
}

void MeshTiles::write_vertices(std::span<const io::Position> positions) {
  if (tile_of_vertex_.size() + positions.size() >= std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorKind::kResource, "verify: 2^32 vertices or more; verify a --crop");
  }
  const audit::Frame at = frame();
  for (const io::Position& written : positions) {
    const std::uint64_t vertex = tile_of_vertex_.size();
    const bool is_finite =
        std::isfinite(written[0]) && std::isfinite(written[1]) && std::isfinite(written[2]);
    if (!is_finite) endless_.add([&] { return std::to_string(vertex); });
    tile_of_vertex_.push_back(
        grid_.at(is_finite ? at.in_voxels(in_array(written)) : audit::Position{}));
  }
  positions_.append(std::as_bytes(positions));
}

void MeshTiles::write_tets(std::span<const io::TetRows> tets, std::span<const RawLabel> labels) {
  for (std::size_t i = 0; curved_ && i < tets.size(); ++i) {
    keep_nodes(tet_count_ + i, tets[i], labels[i]);
  }
  constexpr std::size_t kBatch = 8192;
  for (std::size_t at = 0; at < tets.size(); at += kBatch) {
    const std::size_t count = std::min(kBatch, tets.size() - at);
    add(look_at(tet_count_, tets.subspan(at, count), labels.subspan(at, count)));
  }
}

MeshTiles::TetShare MeshTiles::look_at(std::uint64_t first, std::span<const io::TetRows> tets,
                                       std::span<const RawLabel> labels) {
  TetShare out{.tet_count = tets.size()};
  RawLabel last = 0;
  for (std::size_t i = 0; i < tets.size(); ++i) {
    Tet tet{.id = first + i, .vertices = tets[i]};
    if (!in_range(tet, out.range_error)) continue;
    if (out.labels.empty() || labels[i] != last) {
      last = labels[i];
      out.labels.push_back(table_.find(last));
    }
    tet.label = out.labels.back() == kExterior ? audit::kUnknown : out.labels.back();
    add_to_tiles(tet, out.tets);
  }
  out.tets.pack();
  return out;
}

bool MeshTiles::in_range(const Tet& tet, std::string& error) const {
  for (const std::uint64_t v : tet.vertices) {
    if (v < tile_of_vertex_.size()) continue;
    if (error.empty()) {
      error = "audit: tet " + std::to_string(tet.id) + " names vertex " + std::to_string(v) +
              " of " + std::to_string(tile_of_vertex_.size());
    }
    return false;
  }
  return true;
}

/// Returns the tile of a vertex, and notes that a tet has it.
std::uint32_t MeshTiles::use(std::uint64_t vertex) {
  const std::atomic_ref<std::uint32_t> tile(tile_of_vertex_[vertex]);
  const std::uint32_t found = tile.load(std::memory_order_relaxed);
  if ((found & kUsed) == 0) tile.fetch_or(kUsed, std::memory_order_relaxed);
  return found & ~kUsed;
}

void MeshTiles::add_to_tiles(Tet tet, TileShares<Tet>& out) {
  std::array<std::uint32_t, 4> tiles{};
  for (std::size_t i = 0; i < 4; ++i) tiles[i] = use(tet.vertices[i]);
  std::sort(tiles.begin(), tiles.end());
  const auto end = std::unique(tiles.begin(), tiles.end());
  if (is_mirrored_) std::swap(tet.vertices[2], tet.vertices[3]);
  tet.is_shared = end - tiles.begin() > 1 ? 1 : 0;
  for (auto tile = tiles.begin(); tile != end; ++tile) out.add(*tile, tet);
}

void MeshTiles::add(const TetShare& found) {
  tet_count_ += found.tet_count;
  tets_.add(found.tets);
  for (const Label label : found.labels) {
    if (label != kExterior) labels_[label] = true;
  }
  if (range_error_.empty()) range_error_ = found.range_error;
}

/// Collects the nodes of a curved tet.  A part at a corner has it and the middles of its edges.
void MeshTiles::keep_nodes(std::uint64_t tet, const io::TetRows& part, RawLabel label) {
  const std::size_t number = tet % kTetParts.size();
  for (std::size_t i = 0; i < part.size(); ++i) next_.rows[kTetParts[number][i]] = part[i];
  next_.label = table_.find(label);
  if (number + 1 == kTetParts.size()) curved_tets_.append(std::as_bytes(std::span(&next_, 1)));
}

void MeshTiles::measure_curved() {
  std::uint64_t tet = 0;
  const audit::Frame lattice = audit::layered_frame(frame(), layers_);
  const double voxel = lattice.spacing[0] * lattice.spacing[1] * lattice.spacing[2];
  curved_tets_.each_batch<CurvedTet>([&](std::span<const CurvedTet> batch) {
    std::vector<std::uint64_t> ids;
    for (const CurvedTet& t : batch) ids.insert(ids.end(), t.rows.begin(), t.rows.end());
    sort_distinct(ids);
    std::vector<audit::Position> places;
    read_positions(ids, places);
    for (const CurvedTet& t : batch) {
      audit::TenNodes nodes;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto found = std::lower_bound(ids.begin(), ids.end(), t.rows[i]);
        nodes[i] = in_array(places[static_cast<std::size_t>(found - ids.begin())]);
      }
      if (is_mirrored_) nodes = audit::mirrored(nodes);
      curved_->add(tet++, nodes);
      if (t.label >= beyond_parts_.size()) continue;
      beyond_parts_[t.label].add(audit::volume_beyond_parts(nodes) / voxel);
    }
  });
}

void MeshTiles::finish() {
  if (curved_ && range_error_.empty() && endless_.count() == 0) measure_curved();
  for (std::size_t v = 0; v < tile_of_vertex_.size(); ++v) {
    if ((tile_of_vertex_[v] & kUsed) == 0) unused_.add([v] { return std::to_string(v); });
    tile_of_vertex_[v] &= ~kUsed;
  }
}

audit::Check MeshTiles::input_check() const {
  if (!range_error_.empty()) return {"P2 input", false, range_error_};
  return audit::input_check(tile_of_vertex_.size(), tet_count_, endless_);
}

/// Reads the positions of ascending vertices; neighbours in the file are read at once.
void MeshTiles::read_positions(std::span<const std::uint64_t> ids,
                               std::vector<audit::Position>& out) const {
  constexpr std::uint64_t kWorthReading = 64;
  std::vector<audit::Position> block;
  const std::lock_guard lock(mutex_);
  for (std::size_t begin = 0, end = 0; begin < ids.size(); begin = end) {
    for (end = begin + 1; end < ids.size() && ids[end] - ids[end - 1] <= kWorthReading;) ++end;
    block.resize(ids[end - 1] - ids[begin] + 1);
    positions_.read_at(ids[begin] * sizeof(audit::Position),
                       std::as_writable_bytes(std::span(block)));
    for (std::size_t i = begin; i < end; ++i) out.push_back(block[ids[i] - ids[begin]]);
  }
}

LoadedMesh MeshTiles::make(const std::vector<Tet>& tets) const {
  LoadedMesh out;
  for (const Tet& tet : tets) {
    out.tet_ids.push_back(tet.id);
    out.labels.push_back(tet.label);
    out.is_shared.push_back(tet.is_shared != 0);
    out.vertex_ids.insert(out.vertex_ids.end(), tet.vertices.begin(), tet.vertices.end());
  }
  sort_distinct(out.vertex_ids);
  for (const Tet& tet : tets) {
    audit::TetRow& row = out.tets.emplace_back();
    for (std::size_t i = 0; i < 4; ++i) {
      row[i] = static_cast<std::uint64_t>(
          std::lower_bound(out.vertex_ids.begin(), out.vertex_ids.end(), tet.vertices[i]) -
          out.vertex_ids.begin());
    }
  }
  read_positions(out.vertex_ids, out.vertices);
  if (!is_upright_) {
    out.written = out.vertices;
    for (audit::Position& p : out.vertices) p = in_array(p);
  }
  std::vector<Label> seen;
  append_labels(out.labels, seen);
  out.names = TileLabels(std::move(seen), table_.size());
  out.names.make_own(out.labels);
  return out;
}

LoadedMesh MeshTiles::take_tile(std::uint32_t tile) {
  std::vector<Tet> tets;
  tets_.take(tile, tets);
  LoadedMesh out = make(tets);
  for (const std::uint64_t id : out.vertex_ids) {
    out.owned.push_back(tile_of_vertex_[id] == tile ? 1 : 0);
  }
  return out;
}

}  // namespace mw::engine
