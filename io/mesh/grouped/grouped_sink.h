// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A sink that makes a grouped mesh of a stream of tets.
#pragma once

#include "io/file/scratch/external_sort.h"
#include "io/labels/label_table.h"
#include "io/mesh/grouped/curved_nodes.h"
#include "io/mesh/grouped/curved_parts.h"
#include "io/mesh/grouped/grouped_mesh.h"
#include "io/mesh/merged_vertices.h"

namespace mw::io {

/// Collects a mesh; finish() groups it and calls the writer.
/// Memory: 64 MiB, 96 with kTet10, 136 with curves, whatever the mesh; the rest waits in
/// temporary files in `folder`, at most some 400 bytes a tet (1,000 with kTet10, 1,300 with curved
/// ones).
/// ERRORS: see MeshSink; kInput when a tet names a vertex that never came, or three tets share a
/// triangle, which then bounds nothing; begin() throws kUsage where kCurvedTet10 is asked of a mesh
/// with doubled vertices.  ENSURES: with kCurvedTet10 a mesh that comes in the parts of curved tets
/// has these again, each node where it was.
class GroupedSink : public MeshSink {
 public:
  /// writer may be empty where the caller takes the mesh.  With curves, nodes lie where
  /// curve_nodes() places them; kCurvedTet10 has curves of its own.
  /// REQUIRES: folder exists; curves: an element with middles.
  GroupedSink(const std::filesystem::path& folder, std::unique_ptr<GroupedWriter> writer,
              Element element = Element::kTet4, std::optional<CurveRule> curves = {});

  void begin(const MeshHeader& header) override;
  void write_vertices(std::span<const Position> positions) override;
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) override;
  void write_values(std::span<const double> rows) override;
  void finish() override;
  [[nodiscard]] std::uint64_t buffer_bytes() const override;

  /// REQUIRES: finished.
  [[nodiscard]] GroupedMesh& mesh() { return mesh_; }

 private:
  static constexpr std::size_t kSortBytes = 8 << 20;
  /// Three ascending rows, the first one for doubled vertices, and 4 * tet + opposite corner.
  using FaceRecord = std::array<std::uint64_t, 4>;
  using Faces = ExternalSort<4>;
  /// Side << 32 | first, second, 4 * tet + opposite corner of the first, and of the second.
  using Facets = ExternalSort<4>;

  /// Returns the row of the vertex that `row` doubles, or `row`.
  [[nodiscard]] std::uint64_t first_of(std::uint64_t row) const {
    return doubles_ ? doubles_->first(row) : row;
  }
  void group();
  void find_box();
  void sort_tets(Faces& faces);
  void place_tet(TetRows tet, Faces& faces);
  void place_values(std::uint64_t tet);
  void pair_faces(Faces& faces, Facets& facets);
  void add_facet(std::span<const FaceRecord> sharing, Facets& facets);
  void number_facets(Facets& facets);
  void find_wedges();
  void add_wedges(const FacetGroup& group, bool is_first_bottom);
  void find_middles();
  [[nodiscard]] PagedArray<Position> given_nodes();

  std::filesystem::path folder_;
  GroupedMesh mesh_;
  ScratchFile tets_;          ///< a TetRecord of each, as they came
  PagedFile<double> values_;  ///< those of tets as they came
  LabelSet labels_;
  std::optional<DoubledVertices> doubles_;
  Position lo_{};
  Position hi_{};
  std::unique_ptr<GroupedWriter> writer_;
  std::optional<CurveRule> curves_;
  std::optional<CurvedParts> parts_;                   ///< of a mesh that is curved as it comes
  std::optional<PagedFile<SixPlaces>> given_middles_;  ///< of parts_, by tet
};

}  // namespace mw::io
