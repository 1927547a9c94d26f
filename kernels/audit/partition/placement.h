// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Whether a mesh lies as the volume does, and not mirrored, turned, or with labels exchanged.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "kernels/audit/check.h"
#include "kernels/audit/subject.h"

namespace mw::audit {

/// Voxels of one label whose centres lie in tets of another one.
struct MissedCentres {
  Label label = 0;
  Label found = 0;
  std::uint64_t voxels = 0;
};

/// Voxels, and those of them whose centres lie where they are wanted.
struct PlaceTally {
  std::uint64_t voxels = 0;
  std::uint64_t hits = 0;
  std::vector<MissedCentres> missed;  ///< those in tets of another label; no pair twice

  /// Adds the numbers of another tally, but not its list.
  void add(const PlaceTally& other) {
    voxels += other.voxels;
    hits += other.hits;
  }
};

/// What the centre of a voxel is to lie in, by label: a tet of the label, no tet (kLeftOut), or
/// anything (kUnknown), as of labels of which parts were left out.
using WantedCentres = std::vector<Label>;
[[nodiscard]] WantedCentres wanted_centres(std::size_t label_count, const KeptLabels& kept,
                                           const KeptLabels& partial);

/// Counts voxels by their labels.  centres has the label of the tet at each voxel's centre
/// (centre_labels()).  REQUIRES: as many labels as centres.
[[nodiscard]] PlaceTally tally_places(std::span<const Label> labels, std::span<const Label> centres,
                                      const WantedCentres& wanted);

/// The voxels with which symmetries of the box are tried: all of them, or every second, third and
/// so on along each axis, counted from the middle, so that they are no more than kMostSamples.
/// A symmetry of the box takes samples to samples.
/// Memory: 8 bytes a sample.  Thread safety: put() may be called at once for different boxes.
class PlaceSamples {
 public:
  static constexpr std::int64_t kMostSamples = std::int64_t{1} << 20;

  explicit PlaceSamples(Index3 shape);

  /// Takes what tally_places() takes, of a box.
  void put(const Box3& box, std::span<const Label> labels, std::span<const Label> centres,
           const WantedCentres& wanted);

  /// How many samples are where they are wanted.
  struct Hits {
    std::uint64_t as_it_lies = 0;
    std::uint64_t otherwise = 0;  ///< where a symmetry puts the mesh
    std::uint64_t changed = 0;    ///< samples that are wanted in another label by the symmetry

    /// True if the mesh is that of the symmetry: it has more hits, by more than three times the
    /// root of the samples that it changes.  What falls on a centre near an interface is chance, as
    /// if a coin were thrown for each of them.
    [[nodiscard]] bool is_turned() const;
  };
  /// Returns the hits of a symmetry that has most of them, of one that is_turned() if any is.  A
  /// symmetry with fewer hits than the mesh as it lies counts as one without any.
  [[nodiscard]] Hits count() const;
  [[nodiscard]] std::uint64_t size() const { return wanted_.size(); }

 private:
  using Axes = std::array<std::size_t, 3>;

  [[nodiscard]] Index3 counts() const;
  [[nodiscard]] std::array<std::uint64_t, 8> equal_to(const std::vector<Label>& turned,
                                                      const Axes& axes, std::uint64_t enough) const;

  Index3 shape_;
  std::array<std::vector<std::int64_t>, 3> at_;  ///< ascending, by axis
  std::vector<Label> wanted_;
  std::vector<Label> centres_;
};

/// Finds labels that are exchanged: more than half of the voxels of two lie in the other's tets.
class ExchangedLabels {
 public:
  explicit ExchangedLabels(const LabelText& names) : names_(names) {}
  /// Takes how many voxels two labels have together, and how many of them lie in the other's tets.
  void add(Label one, Label other, std::uint64_t voxels, std::uint64_t exchanged);
  [[nodiscard]] const Offenders& found() const { return found_; }

 private:
  const LabelText& names_;
  Offenders found_{"pairs of labels exchanged"};
};

/// Returns the check "P4 place": no symmetry of the box fits better than the mesh as it lies
/// (PlaceSamples::Hits), more than half of the voxels are where they are wanted, and no labels are
/// exchanged.
[[nodiscard]] Check judge_places(const PlaceTally& all, const PlaceSamples& samples,
                                 const ExchangedLabels& exchanged);

}  // namespace mw::audit
