// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The sorts that turn a stream of tets into a grouped mesh.
#pragma once

#include "io/file/external_sort.h"
#include "io/labels/label_set.h"
#include "io/mesh/grouped/grouped_mesh.h"

namespace mw::io {

/// Takes vertices and tets, then groups them.
class MeshGrouping {
 public:
  MeshGrouping(const std::filesystem::path& folder, Element element);

  void begin(const MeshHeader& header) { mesh_.header_ = header; }
  void add_vertices(std::span<const Position> positions);
  void add_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels);
  /// Called once, after everything was added.
  void group();
  [[nodiscard]] GroupedMesh& mesh() { return mesh_; }

 private:
  static constexpr std::size_t kSortBytes = 8 << 20;
  /// Three ascending rows, and 4 * tet + opposite corner.
  using FaceRecord = std::array<std::uint64_t, 4>;
  using Faces = ExternalSort<4>;
  /// Side << 32 | first, second, 4 * tet + opposite corner.
  using Facets = ExternalSort<3>;

  void find_box();
  void sort_tets(Faces& faces);
  void place_tet(TetRows tet, Faces& faces);
  void pair_faces(Faces& faces, Facets& facets);
  void add_facet(std::span<const FaceRecord> sharing, Facets& facets);
  void number_facets(Facets& facets);
  void find_middles();

  std::filesystem::path folder_;
  GroupedMesh mesh_;
  ScratchFile tets_;  ///< four rows and the label of each, as they came
  LabelSet labels_;
  Position lo_{};
  Position hi_{};
};

}  // namespace mw::io
