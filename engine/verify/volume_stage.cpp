// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads a tile's labels with those around them, once, and looks at them.
#include "engine/verify/volume_stage.h"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <limits>
#include <memory>
#include <mutex>

#include "engine/labels/reading_tiles.h"
#include "engine/system/crew.h"
#include "engine/system/in_order.h"
#include "engine/verify/part_links.h"
#include "engine/verify/tile_labels.h"
#include "io/volume/volume_readers.h"
#include "kernels/audit/distance/tile.h"
#include "kernels/audit/shape/volumes.h"
#include "kernels/audit/topology/parts_union.h"
#include "kernels/core/index.h"
#include "kernels/core/lattice.h"

namespace mw::engine {
namespace {

/// Distances of a tile, by label of the whole.
struct TileDistances {
  std::vector<Label> labels;
  std::vector<audit::LabelDistances> rows;
};

/// What samples of a tile find that look farther, and how far they looked at most.
struct Farther {
  TileDistances distances;
  double reach = 0;
};

struct VoxelFindings {
  audit::PartsPiece parts;
  std::vector<audit::SharedRun> shared;
  audit::JunctionsPiece junctions;
  std::vector<Label> labels;  ///< of the tile; what follows is by their ranks
  std::vector<audit::VoxelCount> voxels;
  std::vector<audit::VoxelPinches> pinches;
  audit::PlaceTally places;
  TileDistances distances;
};

/// Labels of a box of the volume.
struct LoadedVoxels {
  Box3 box;
  std::vector<Label> labels;

  [[nodiscard]] bool has_one_label() const {
    return std::equal(labels.begin() + 1, labels.end(), labels.begin());
  }
  [[nodiscard]] LoadedVoxels part(const Box3& of) const {
    LoadedVoxels out{of, std::vector<Label>(static_cast<std::size_t>(of.voxels()))};
    copy_box<Label>(of, box, labels, of, out.labels);
    return out;
  }
};

Box3 scaled(const Box3& box, Index3 by) {
  return {layered_shape(box.lo, by), layered_shape(box.hi, by)};
}

/// Memory that threads share: one that finds too little waits for others to give some back, and
/// where it is alone it may have any amount.
class SharedMemory {
 public:
  explicit SharedMemory(std::uint64_t bytes) : all_(bytes) {}

  /// Calls work once there is memory for it.
  template <class Work>
  void with(std::uint64_t bytes, Work work) {
    {
      std::unique_lock lock(mutex_);
      given_back_.wait(lock, [&] { return taken_ == 0 || taken_ + bytes <= all_; });
      taken_ += bytes;
    }
    const std::shared_ptr<void> held(nullptr, [&](void*) {
      const std::lock_guard lock(mutex_);
      taken_ -= bytes;
      given_back_.notify_all();
    });
    work();
  }

 private:
  std::mutex mutex_;
  std::condition_variable given_back_;
  std::uint64_t all_;
  std::uint64_t taken_ = 0;
};

class VolumeStage {
 public:
  VolumeStage(const io::DenseVolume& volume, const TileGrid& grid, const VerifyTask& task,
              const MeshInterface& mesh)
      : volume_(volume),
        grid_(grid),
        task_(task),
        centres_(mesh.centres),
        pieces_(mesh.pieces),
        junctions_(mesh.junctions),
        label_count_(volume.table().size()),
        readers_(volume.info().is_far ? task.readers : 1),
        layers_(task.options.layers),
        limit_(audit::distance_limit(task.options.max_distance)),
        parts_(label_count_),
        links_(task.folder, task.memory_bytes / 8),
        missed_(task.folder, task.memory_bytes / 16),
        rows_(label_count_ + 2) {
    found_.voxels.resize(label_count_);
    found_.pinches.resize(label_count_);
    if (centres_ == nullptr) return;
    samples_.emplace(grid.shape());
    wanted_ = audit::wanted_centres(label_count_, task.options.kept, task.options.partial);
  }

  VolumeFindings run() {
    each_in_order<VoxelFindings>(
        {task_.threads}, grid_.size(), [this](std::uint32_t tile) { return look_at(tile); },
        [this](std::uint32_t tile, VoxelFindings&& found) { merge(tile, std::move(found)); });
    links_.unite(parts_);
    found_.betti = parts_.betti_of_volume();
    if (junctions_ != nullptr) junctions_->close(JunctionLedger::Side::kVolume, parts_.cavities());
    if (centres_ != nullptr) judge_places();
    if (pieces_ != nullptr) conclude_distances();
    return std::move(found_);
  }

 private:
  /// Returns how far to look at first: beyond the bound, to say by how much it is broken.
  [[nodiscard]] double first_reach() const {
    constexpr double kMin = 2, kBeyond = 0.5;
    return std::max(kMin, task_.options.max_distance.value_or(4 - kBeyond) + kBeyond);
  }

  /// Returns the box grown by this many voxels of the lattice, cut to the grid.
  [[nodiscard]] Box3 around(const Box3& box, double voxels) const {
    const auto along = [&](std::int64_t layers) {
      const double wide = std::ceil(voxels / static_cast<double>(layers)) + 1;
      return static_cast<std::int64_t>(std::min(wide, 1e9));
    };
    const Index3 by{along(layers_.x), along(layers_.y), along(layers_.z)};
    return intersection({box.lo - by, box.hi + by}, {{0, 0, 0}, grid_.shape()});
  }

  [[nodiscard]] LoadedVoxels load(const Box3& box) const {
    LoadedVoxels out{box, std::vector<Label>(static_cast<std::size_t>(box.voxels()))};
    if (readers_ == 1) {
      volume_.read(box, out.labels);
      return out;
    }
    const ReadingTiles tiles(volume_.info());
    const Box3 over = tiles.over(box);
    tbb_for_each_index(readers_, over.shape(), [&](Index3 i) {
      const LabelBox part = read_labels(volume_, intersection(tiles.box(over.lo + i), box));
      copy_box<Label>(part.box, part.box, part.labels, box, out.labels);
    });
    return out;
  }

  [[nodiscard]] VoxelFindings look_at(std::uint32_t tile) const {
    const Box3 box = grid_.box(tile);
    const double reach = first_reach();
    const double halo = pieces_ == nullptr ? 1 : reach + pieces_->radius();
    LoadedVoxels loaded = load(around(box, halo));
    VoxelFindings out;
    task_.between();
    take_parts(box, loaded, out);
    task_.between();
    if (centres_ != nullptr) out.places = places(tile, loaded.part(box));
    task_.between();
    if (pieces_ != nullptr) out.distances = measure(box, reach, std::move(loaded));
    return out;
  }

  /// Compares a tile with the tets at its voxels' centres.
  [[nodiscard]] audit::PlaceTally places(std::uint32_t tile, const LoadedVoxels& voxels) const {
    std::vector<audit::CentreRun> runs;
    centres_->load(tile, runs);
    const std::vector<Label> centres = audit::centre_labels(runs, voxels.box, grid_.shape());
    samples_->put(voxels.box, voxels.labels, centres, wanted_);
    return audit::tally_places(voxels.labels, centres, wanted_);
  }

  void take_parts(const Box3& box, const LoadedVoxels& loaded, VoxelFindings& out) const {
    const Box3 all{{0, 0, 0}, grid_.shape()};
    const Box3 needed = intersection({box.lo - Index3{1, 1, 1}, box.hi}, all);
    LoadedVoxels voxels = loaded.part(needed);
    std::vector<Label> seen;
    append_labels(voxels.labels, seen);
    const TileLabels names(std::move(seen), label_count_);
    names.make_own(voxels.labels);
    count_voxels(box, voxels, names, out);
    // Vertices on the far sides of the volume are those of the last tiles.
    const auto end = [](std::int64_t hi, std::int64_t last) { return hi == last ? hi + 1 : hi; };
    const Box3 owned{box.lo,
                     {end(box.hi.x, all.hi.x), end(box.hi.y, all.hi.y), end(box.hi.z, all.hi.z)}};
    const audit::VoxelTile tile{{needed.shape(), voxels.labels}, grid_.shape(), needed, owned};
    audit::VoxelParts parts = audit::voxel_parts(tile, names.size());
    out.parts = std::move(parts.piece);
    out.shared = std::move(parts.shared);
    out.pinches = std::move(parts.pinches);
    names.to_whole(out.parts);
    if (junctions_ == nullptr) return;
    out.junctions = audit::voxel_junctions(tile, names.size());
    names.to_whole(out.junctions);
  }

  void count_voxels(const Box3& box, const LoadedVoxels& voxels, const TileLabels& names,
                    VoxelFindings& out) const {
    out.labels = names.whole();
    out.voxels = audit::count_voxels({voxels.box.shape(), voxels.labels}, voxels.box, box,
                                     names.size(), layers_);
  }

  /// Measures the distances of a tile.  Consumes what was loaded.
  [[nodiscard]] TileDistances measure(const Box3& box, double reach, LoadedVoxels loaded) const {
    std::vector<audit::InterfaceTriangle> pieces =
        pieces_->near(around(box, reach + 2 * pieces_->radius()));
    const Box3 lattice_box = scaled(box, layers_);
    std::erase_if(pieces, [&](const auto& piece) { return is_beyond(piece, lattice_box, reach); });
    if (pieces.empty() && loaded.has_one_label()) return {};
    const TileLabels names(seen_in(loaded, pieces), label_count_);
    names.make_own(loaded.labels);
    for (audit::InterfaceTriangle& piece : pieces) {
      for (Label& label : piece.labels) label = own(names, label);
    }
    const Box3 lattice_loaded = scaled(loaded.box, layers_);
    const bool is_all = loaded.box == Box3{{0, 0, 0}, grid_.shape()};
    audit::LayeredLabels lattice{lattice_loaded.shape(), {}};
    if (layers_ == Index3{1, 1, 1}) {
      lattice.labels = std::move(loaded.labels);
    } else {
      lattice = audit::layered_labels({loaded.box.shape(), loaded.labels}, layers_);
    }
    audit::DistanceTask task{
        .voxels = {lattice.view(), layered_shape(grid_.shape(), layers_), lattice_loaded, {}},
        .pieces = pieces,
        .label_count = names.size(),
        .kept = names.own(task_.options.kept),
        .samples = lattice_box,
        .limit = limit_};
    if (!is_all) task.reach = reach;
    TileDistances out{whole_rows(names), audit::measure_distances(task)};
    forget_partial(out);
    return out;
  }

  /// Forgets how far voxels are from the mesh for labels of which parts were left out.
  void forget_partial(TileDistances& distances) const {
    for (std::size_t i = 0; i < distances.rows.size(); ++i) {
      if (!audit::is_partial(task_.options.partial, distances.labels[i])) continue;
      distances.rows[i].to_mesh = {};
    }
  }

  static std::vector<Label> seen_in(const LoadedVoxels& loaded,
                                    const std::vector<audit::InterfaceTriangle>& pieces) {
    std::vector<Label> seen;
    append_labels(loaded.labels, seen);
    for (const audit::InterfaceTriangle& piece : pieces) {
      seen.insert(seen.end(), piece.labels.begin(), piece.labels.end());
    }
    return seen;
  }

  /// Returns the tile's label; the two behind the last label are so in the tile as well.
  [[nodiscard]] Label own(const TileLabels& names, Label label) const {
    const auto count = static_cast<Label>(label_count_);
    return label < count ? names.own(label) : static_cast<Label>(names.size()) + (label - count);
  }

  [[nodiscard]] std::vector<Label> whole_rows(const TileLabels& names) const {
    std::vector<Label> out = names.whole();
    out.push_back(static_cast<Label>(label_count_));
    out.push_back(static_cast<Label>(label_count_ + 1));
    return out;
  }

  [[nodiscard]] static bool is_beyond(const audit::InterfaceTriangle& piece, const Box3& box,
                                      double reach) {
    const audit::Extent extent = audit::extent_of(piece.corners);
    const std::array<std::int64_t, 3> lo{box.lo.x, box.lo.y, box.lo.z};
    const std::array<std::int64_t, 3> hi{box.hi.x, box.hi.y, box.hi.z};
    // The margin is a voxel wider than the reach.  Tiles at low sides measure pieces outside, too.
    for (std::size_t k = 0; k < 3; ++k) {
      if (extent.hi[k] < static_cast<double>(lo[k]) - reach - 1) return lo[k] > 0;
      if (extent.lo[k] > static_cast<double>(hi[k]) + reach + 1) return true;
    }
    return false;
  }

  void merge(std::uint32_t tile, VoxelFindings&& found) {
    const std::uint32_t first = parts_.add(std::move(found.parts));
    for (const audit::SharedRun& run : found.shared) {
      links_.add(run.first, run.count, first + run.part);
    }
    for (std::size_t i = 0; i < found.labels.size(); ++i) {
      audit::VoxelCount& all = found_.voxels[found.labels[i]];
      all.voxels += found.voxels[i].voxels;
      all.faces += found.voxels[i].faces;
      found_.pinches[found.labels[i]].add(found.pinches[i]);
    }
    places_.add(found.places);
    for (const auto& [label, in, voxels_missed] : found.places.missed) {
      missed_.add({std::min(label, in), std::max(label, in), voxels_missed});
    }
    if (junctions_ != nullptr) junctions_->add(JunctionLedger::Side::kVolume, found.junctions);
    if (has_far(found.distances)) {
      far_.push_back(tile);
      note_presence(found.distances);
      far_distances_.push_back(std::move(found.distances));
    } else {
      add(found.distances);
    }
    task_.between();
  }

  void judge_places() {
    audit::ExchangedLabels exchanged(task_.options.label_text);
    std::array<std::uint64_t, 3> sum{};  // two labels, and voxels of each in tets of the other
    const auto close = [&] {
      if (sum[2] == 0) return;
      exchanged.add(static_cast<Label>(sum[0]), static_cast<Label>(sum[1]),
                    found_.voxels[sum[0]].voxels + found_.voxels[sum[1]].voxels, sum[2]);
    };
    missed_.each([&](const std::array<std::uint64_t, 3>& record) {
      if (record[0] != sum[0] || record[1] != sum[1]) {
        close();
        sum = {record[0], record[1], 0};
      }
      sum[2] += record[2];
    });
    close();
    found_.place = audit::judge_places(places_, *samples_, exchanged);
  }

  static bool has_far(const TileDistances& distances) {
    return std::any_of(
        distances.rows.begin(), distances.rows.end(),
        [](const audit::LabelDistances& row) { return row.to_input.far + row.to_mesh.far > 0; });
  }

  void note_presence(const TileDistances& distances) {
    for (std::size_t i = 0; i < distances.rows.size(); ++i) {
      audit::LabelDistances& row = rows_[distances.labels[i]];
      row.in_volume = row.in_volume || distances.rows[i].in_volume;
      row.in_mesh = row.in_mesh || distances.rows[i].in_mesh;
    }
  }

  void add(const TileDistances& distances) {
    for (std::size_t i = 0; i < distances.rows.size(); ++i) {
      rows_[distances.labels[i]].add(distances.rows[i]);
    }
  }

  /// Lets samples that found nothing of their label look farther, if there is something at all.
  void conclude_distances() {
    const std::vector<bool> is_found = found_labels();
    SharedMemory memory(task_.memory_bytes);
    double reach = std::numeric_limits<double>::infinity();
    each_in_order<Farther>(
        {task_.threads}, far_.size(),
        [&](std::size_t i) {
          return look_farther(far_[i], std::move(far_distances_[i]), is_found, memory);
        },
        [&](std::size_t, Farther&& farther) {
          reach = std::min(reach, farther.reach);
          add(farther.distances);
          task_.between();
        });
    found_.distance = audit::conclude_distances(rows_, limit_, reach);
  }

  /// Returns by label whether volume and mesh have it.
  [[nodiscard]] std::vector<bool> found_labels() const {
    std::vector<bool> out(rows_.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = rows_[i].in_volume && rows_[i].in_mesh;
    return out;
  }

  [[nodiscard]] static bool waits(const TileDistances& distances,
                                  const std::vector<bool>& is_found) {
    for (std::size_t i = 0; i < distances.rows.size(); ++i) {
      const audit::LabelDistances& row = distances.rows[i];
      if (is_found[distances.labels[i]] && row.to_input.far + row.to_mesh.far > 0) return true;
    }
    return false;
  }

  /// Looks as far as memory lets it.
  [[nodiscard]] Farther look_farther(std::uint32_t tile, TileDistances&& distances,
                                     const std::vector<bool>& is_found,
                                     SharedMemory& memory) const {
    constexpr double kStep = 4;
    constexpr std::uint64_t kBytesAVoxel = 32;
    const Box3 box = grid_.box(tile);
    Farther out{std::move(distances), first_reach()};
    while (waits(out.distances, is_found)) {
      const Box3 farther = around(box, kStep * out.reach + pieces_->radius());
      const auto voxels = static_cast<std::uint64_t>(farther.voxels() * layers_.product());
      if (voxels > task_.memory_bytes / kBytesAVoxel) return out;
      out.reach *= kStep;
      memory.with(kBytesAVoxel * voxels,
                  [&] { out.distances = measure(box, out.reach, load(farther)); });
    }
    out.reach = std::numeric_limits<double>::infinity();
    return out;
  }

  const io::DenseVolume& volume_;
  const TileGrid& grid_;
  const VerifyTask& task_;
  const CentreBuckets* centres_;
  const PieceBuckets* pieces_;
  JunctionLedger* junctions_;
  std::size_t label_count_;
  int readers_;
  Index3 layers_;
  double limit_;
  VolumeFindings found_;
  audit::PartsUnion parts_;
  PartLinks links_;
  mutable std::optional<audit::PlaceSamples> samples_;  ///< each tile puts its own
  audit::WantedCentres wanted_;
  audit::PlaceTally places_;
  io::ExternalSort<3> missed_;
  std::vector<audit::LabelDistances> rows_;
  std::vector<std::uint32_t> far_;
  std::vector<TileDistances> far_distances_;
};

}  // namespace

std::uint64_t reader_bytes(const io::LabelVolume& volume) {
  // Labels of a tile, dense and, in part, as they are read; and what a request takes.
  constexpr std::uint64_t kTileBytes = std::uint64_t{3} << 20U;
  if (!volume.info().is_far) return 0;
  return kTileBytes + volume.buffer_bytes(2) - volume.buffer_bytes(1);
}

int readers_of_thread(int threads, std::uint64_t reader_bytes, std::uint64_t memory) {
  if (reader_bytes == 0) return 1;
  const auto n = static_cast<std::uint64_t>(threads);
  int each = (io::kFarReaders + threads - 1) / threads;
  while (each > 1 && n * static_cast<std::uint64_t>(each) * reader_bytes > memory) --each;
  return each;
}

VolumeFindings look_at_volume(const io::DenseVolume& volume, const TileGrid& grid,
                              const VerifyTask& task, const MeshInterface& mesh) {
  return VolumeStage(volume, grid, task, mesh).run();
}

}  // namespace mw::engine
