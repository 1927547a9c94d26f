// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Places of a volume: one look at every lattice vertex and the cells that it owns.
#include <algorithm>
#include <array>

#include "kernels/audit/place_counter.h"
#include "kernels/audit/voxel_runs.h"

namespace mw::audit {
namespace {

/// At most eight labels, ascending and distinct.
class FewLabels {
 public:
  void add(Label label) {
    std::size_t at = 0;
    while (at < count_ && labels_[at] < label) ++at;
    if (at < count_ && labels_[at] == label) return;
    for (std::size_t i = count_++; i > at; --i) labels_[i] = labels_[i - 1];
    labels_[at] = label;
  }
  [[nodiscard]] std::span<const Label> all() const { return std::span(labels_).first(count_); }

 private:
  std::array<Label, 8> labels_{};
  std::size_t count_ = 0;
};

/// A vertex owns itself and the cells towards +x, +y, +z.
class LatticeSweep {
 public:
  LatticeSweep(const VoxelLabels& volume, std::size_t label_count)
      : volume_(volume),
        exterior_(static_cast<Label>(label_count)),
        vertices_{volume.shape.x + 1, volume.shape.y + 1, volume.shape.z + 1},
        sweep_(static_cast<std::uint64_t>(vertices_.product())) {}

  Places run(const Cavities& cavities) {
    Index3 v;
    for (v.z = 0; v.z < vertices_.z; ++v.z) {
      for (v.y = 0; v.y < vertices_.y; ++v.y) {
        for (v.x = 0; v.x < vertices_.x; ++v.x) look_at(v);
      }
    }
    return sweep_.take(cavities);
  }

 private:
  static constexpr std::array<unsigned, 3> kUpper{0b10101010, 0b11001100, 0b11110000};

  [[nodiscard]] Label label_at(Index3 v) const {
    const Index3 s = volume_.shape;
    if (v.x < 0 || v.y < 0 || v.z < 0 || v.x >= s.x || v.y >= s.y || v.z >= s.z) return exterior_;
    return volume_.labels[static_cast<std::size_t>((v.z * s.y + v.y) * s.x + v.x)];
  }
  [[nodiscard]] std::uint64_t row(Index3 v) const {
    return static_cast<std::uint64_t>((v.z * vertices_.y + v.y) * vertices_.x + v.x);
  }
  [[nodiscard]] std::uint64_t stride(unsigned axis) const {
    const std::int64_t s = axis == 0 ? 1 : axis == 1 ? vertices_.x : vertices_.x * vertices_.y;
    return static_cast<std::uint64_t>(s);
  }

  void look_at(Index3 v) {
    for (int i = 0; i < 8; ++i) {
      around_[static_cast<std::size_t>(i)] =
          label_at({v.x - 1 + (i & 1), v.y - 1 + (i >> 1 & 1), v.z - 1 + (i >> 2)});
    }
    if (std::count(around_.begin(), around_.end(), around_[0]) == 8) return;
    const std::uint64_t here = row(v);
    sweep_.add_vertex(labels_in(0xff).all(), here);
    for (unsigned axis = 0; axis < 3; ++axis) {
      sweep_.add_edge(labels_in(kUpper[axis]).all(), here, here + stride(axis));
      const unsigned u = (axis + 1) % 3, w = (axis + 2) % 3;
      const FewLabels face = labels_in(kUpper[u] & kUpper[w]);
      const std::uint64_t a = here + stride(u), b = here + stride(w);
      sweep_.add_face(face.all(), std::array{here, a, a + stride(w), b});
    }
  }

  /// Labels of the voxels around the vertex that `mask` names.
  [[nodiscard]] FewLabels labels_in(unsigned mask) const {
    FewLabels out;
    for (std::size_t i = 0; i < 8; ++i) {
      if ((mask >> i & 1U) != 0) out.add(around_[i]);
    }
    return out;
  }

  VoxelLabels volume_;
  Label exterior_;
  Index3 vertices_;
  PlaceSweep sweep_;
  std::array<Label, 8> around_{};
};

/// Parts that share a face.  Each row is compared with the one before in y and in z.
class FacePairs {
 public:
  explicit FacePairs(const VoxelRuns& runs) : runs_(runs) {}

  std::vector<PartPair> run() {
    for (std::int64_t z = 0; z <= runs_.shape().z; ++z) {
      for (std::int64_t y = 0; y <= runs_.shape().y; ++y) {
        expand(y, z, here_);
        expand(y - 1, z, other_);
        for (std::size_t x = 0; x < here_.size(); ++x) pairs_.add(here_[x], other_[x]);
        expand(y, z - 1, other_);
        for (std::size_t x = 0; x < here_.size(); ++x) pairs_.add(here_[x], other_[x]);
        std::uint32_t before = runs_.exterior_part();
        for (const std::uint32_t part : here_) {
          pairs_.add(before, part);
          before = part;
        }
        pairs_.add(before, runs_.exterior_part());
      }
    }
    return pairs_.take();
  }

 private:
  /// The part of every voxel of a row.
  void expand(std::int64_t y, std::int64_t z, std::vector<std::uint32_t>& out) const {
    const auto nx = static_cast<std::size_t>(runs_.shape().x);
    out.assign(nx, runs_.exterior_part());
    const RunRow row = runs_.row(y, z);
    for (std::size_t i = 0; i < row.starts.size(); ++i) {
      const std::size_t end = i + 1 < row.starts.size() ? row.starts[i + 1] : nx;
      std::fill(out.begin() + row.starts[i], out.begin() + static_cast<std::ptrdiff_t>(end),
                row.parts[i]);
    }
  }

  const VoxelRuns& runs_;
  PairSet pairs_;
  std::vector<std::uint32_t> here_, other_;
};

}  // namespace

Places voxel_places(const VoxelLabels& volume, std::size_t label_count) {
  Cavities cavities;
  {
    const VoxelRuns runs(volume, label_count);
    cavities = cavities_of_interfaces(runs.part_class(), FacePairs(runs).run());
  }
  return LatticeSweep(volume, label_count).run(cavities);
}

}  // namespace mw::audit
