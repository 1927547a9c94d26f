// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a mesh file tells of the run that made it, as a line of JSON.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/names/mask_labels.h"
#include "io/volume/volume_space.h"
#include "kernels/core/label.h"

namespace mw::io {

using Position = std::array<double, 3>;  ///< physical units

/// A box in the world: a corner and three edges from there, along x, y and z of the array.  The
/// edges are at right angles, not always along the world's axes.
struct MeshBox {
  Position origin{};
  std::array<Position, 3> edges{};

  friend bool operator==(const MeshBox&, const MeshBox&) = default;
};

/// Settings of the run that `verify` asks about: what is checked later is what was promised.
struct MeshPromises {
  std::optional<double> max_distance;  ///< voxels of the lattice; empty: no bound
  double quality_floor = 0;            ///< radius ratio
  bool interfaces = false;             ///< --topology interfaces
  bool smooth = true;                  ///< --surface smooth
  bool optimised = true;               ///< not --optimizer none
  /// Axes of the volume whose two faces have the same triangles (--periodic): bit 0 = x.
  unsigned periodic = 0;
  /// How often each tet was cut into eight after the run; quality_floor is that of the uncut tets.
  int halvings = 0;

  friend bool operator==(const MeshPromises&, const MeshPromises&) = default;
};

/// The most times that each tet is cut into eight.
inline constexpr int kMostHalvings = 2;

/// Interfaces between whose two sides there are wedges of no thickness (--cohesive).
struct CohesiveRule {
  bool all = false;  ///< all interfaces, each from its lower label to its higher one
  /// The label that is under the wedges, and the one that is on top of them; no pair twice.
  std::vector<std::array<RawLabel, 2>> pairs;

  [[nodiscard]] bool any() const { return all || !pairs.empty(); }
  /// True if the interface of these two labels, in any order, has wedges.
  [[nodiscard]] bool has(RawLabel one, RawLabel other) const;
  /// True if a pair of the rule has `one` under its wedges and `other` on top of them.
  [[nodiscard]] bool names(RawLabel one, RawLabel other) const;
  friend bool operator==(const CohesiveRule&, const CohesiveRule&) = default;
};

/// The name that formats with named arrays and groups give the record.
inline constexpr const char* kRecordName = "mwmesh";

struct MeshRecord {
  std::optional<MeshBox> box;  ///< the volume's, whether all its labels are in the mesh or not
  std::optional<MeshPromises> promises;
  WorldFrame frame = WorldFrame::kOwn;  ///< the frame of coordinates
  std::string unit;                     ///< of coordinates, one that nm_in() knows; else empty
  // The labels of the volume that the mesh holds alone, or that it lacks; at most one list has any.
  std::vector<RawLabel> only_labels;
  std::vector<RawLabel> without_labels;
  /// Labels of which parts were left out (--parts), ascending.
  std::vector<RawLabel> partial_labels;
  /// Whether there are vertices that were doubled (--split, --cohesive, --open-hinges).
  bool has_doubles = false;
  /// Whether tets have ten nodes, and curved edges on interfaces.
  bool curved = false;
  /// The wedges are no content of their own: they follow from the tets and the doubled vertices.
  CohesiveRule cohesive{};
  /// The masks that the volume's labels were made of (VolumeInfo::masks), by the labels that the
  /// mesh holds.  No two have one name.
  std::vector<MaskLabels> masks{};

  friend bool operator==(const MeshRecord&, const MeshRecord&) = default;
};

/// The most bytes of a record's text that readers take.
inline constexpr std::size_t kMaxRecordBytes = std::size_t{1} << 24U;

/// {"box": {"origin": [...], "x": [...], "y": [...], "z": [...]}, "promises": {"max_distance": 1.5,
/// "quality_floor": 0.2, "topology": "labels", "surface": "smooth", "optimizer": "none",
/// "periodic": "xy", "halvings": 1},
/// "frame": "ras", "unit": "mm", "only_labels": [...], "without_labels": [...], "partial_labels":
/// [...], "doubled_vertices": true, "curved": true, "cohesive": [1, 2, 1, 3], "masks": [{"name":
/// "liver", "labels": [1, 3]}]}, without what is not known; empty when nothing is.  "cohesive" has
/// the labels under and on top of wedges by turns, or is true for all interfaces.  Labels are
/// signed numbers of 64 bits.  The text is ASCII without a line end, and gives back numbers to the
/// bit.
[[nodiscard]] std::string record_text(const MeshRecord& record);

/// Reads such a text; an empty one is an empty record.  It does not check whether a run can have
/// made such promises.  ERRORS: mw::Error(kInput) naming file and field.
[[nodiscard]] MeshRecord parse_record(std::string_view text, std::string_view file);

}  // namespace mw::io
