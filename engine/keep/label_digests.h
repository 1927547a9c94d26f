// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Digests of the labels that visits see, which tell whether a later volume has the same ones there.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "engine/keep/kept_block.h"
#include "engine/labels/prepared_labels.h"
#include "engine/settings/settings.h"
#include "engine/window/window_grid.h"
#include "io/codec/hasher.h"

namespace mw::engine {

/// What a visit looks at beside the blocks that are stored.
struct SeenLabels {
  std::vector<Index3> starts;  ///< blocks of the first march that are made from voxels
  Box3 content;  ///< voxels that the content of the window touches, maybe in copies of the volume
};

/// Digests of prepared labels, by the labels' own numbers: of each brick of 16^3 voxels, and of
/// what visits see.  Bricks of original labels that no window of this process needs are digested
/// when they are asked for.
/// Thread safety: const members may be called from many threads.
/// Memory: label_digest_bytes().
class LabelDigests {
 public:
  /// grid is that of the first march.  threads do not change digests.  The references outlive it.
  LabelDigests(const PreparedLabels& labels, const LabelKeys& keys, const MeshSettings& settings,
               const WindowGrid& grid, int threads);

  /// Returns the digest of the bricks that have what is seen.  ENSURES: where two volumes agree in
  /// it, exact() is the same, and so is everything that the visit sees.
  [[nodiscard]] io::ContentDigest of_bricks(const SeenLabels& seen) const;
  /// Returns the digest of the very voxels that are seen.  ENSURES: where two volumes agree in it,
  /// so is everything that the visit sees.  Cost: some 10 ns a voxel.
  [[nodiscard]] io::ContentDigest exact(const SeenLabels& seen) const;

 private:
  using Digests = std::vector<io::ContentDigest>;

  using DigestOf = std::function<io::ContentDigest(Index3 brick)>;

  /// Returns the digests of these bricks; those of all others are none.
  [[nodiscard]] Digests digests_of(const Box3& bricks, const DigestOf& of, int threads) const;
  [[nodiscard]] Box3 voxels_of(Index3 brick) const;
  [[nodiscard]] io::ContentDigest original_of(Index3 brick) const;
  [[nodiscard]] io::ContentDigest shape_of(Index3 brick) const;
  [[nodiscard]] io::ContentDigest of_voxels(const LabelBox& labels) const;
  [[nodiscard]] io::ContentDigest of_one_label(Label label, const Box3& voxels) const;
  [[nodiscard]] std::array<std::uint64_t, 2> run_of(Label label, std::size_t end) const;
  [[nodiscard]] Box3 around(const Box3& content) const;
  [[nodiscard]] std::array<bool, 3> repeats() const;
  [[nodiscard]] Index3 place_of(Index3 brick) const;
  template <typename Use>
  void each_part(const Box3& box, Use use) const;
  /// Calls use for the bricks of the volume that a box, or a part of it in a copy, meets.
  template <typename Use>
  void each_brick(const Box3& voxels, Use use) const;
  void add_originals(const Box3& voxels, io::DigestMaker& to) const;
  void add_shapes(const Box3& voxels, io::DigestMaker& to) const;
  void add_voxels(const LabelBox& labels, io::DigestMaker& to) const;
  void add_cells(const Box3& block, io::DigestMaker& to) const;
  void add_limits(const Box3& voxels, io::DigestMaker& to) const;
  /// True if each brick has one label, and with as_shapes also one coarsened label.
  [[nodiscard]] bool all_uniform(const Box3& voxels, bool as_shapes) const;

  const PreparedLabels& labels_;
  const LabelKeys& keys_;
  const WindowGrid& grid_;
  std::optional<std::int64_t> reach_;  ///< how far the distance bound looks, if there is one
  Index3 bricks_;
  Index3 margin_;  ///< PreparedLabels::margin()
  Digests originals_;
  Digests shapes_;  ///< empty where labels are not coarsened
};

/// Returns the memory that LabelDigests takes for a volume of this shape.
[[nodiscard]] std::uint64_t label_digest_bytes(Index3 shape);

}  // namespace mw::engine
