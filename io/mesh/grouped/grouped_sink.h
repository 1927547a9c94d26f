// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A sink that makes a grouped mesh of a stream of tets.
#pragma once

#include "io/file/scratch/external_sort.h"
#include "io/labels/label_table.h"
#include "io/mesh/grouped/curved_nodes.h"
#include "io/mesh/grouped/curved_parts.h"
#include "io/mesh/grouped/grouped_mesh.h"
#include "io/mesh/scratch_mesh.h"

namespace mw::io {

/// Collects a mesh; finish() groups it and calls `write`.
/// Memory: 64 MiB, 96 with kTet10, 136 with curves, whatever the mesh; the rest waits in
/// temporary files in `folder`, at most some 400 bytes a tet (1,000 with kTet10, 1,300 with curved
/// ones).
/// ERRORS: see MeshSink; kInput when a tet names a vertex that never came, or three tets share a
/// triangle, which then bounds nothing; begin() throws kUsage where kCurvedTet10 is asked of a mesh
/// with doubled vertices.  ENSURES: with kCurvedTet10 a mesh that comes in the parts of curved tets
/// has these again, each node where it was.
class GroupedSink : public MeshSink {
 public:
  /// The most that buffer_bytes() returns.
  static constexpr std::uint64_t kMostBytes = std::uint64_t{136} << 20U;

  /// write may be empty where the caller takes the mesh.  With curves, nodes lie where
  /// curve_nodes() places them; kCurvedTet10 has those of the mesh (ScratchMesh::curved_nodes()),
  /// or, where there are none, curves of its own.  REQUIRES: folder exists; curves: an element with
  /// middles.
  GroupedSink(const std::filesystem::path& folder, WriteGrouped write,
              Element element = Element::kTet4, std::optional<CurveRule> curves = {});

  void begin(const MeshHeader& header) override;
  void write_vertices(std::span<const Position> positions) override;
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) override;
  void write_values(std::span<const double> rows) override;
  void finish() override;
  /// Copies the mesh only where there is none.
  void take(ScratchMesh& mesh, const std::function<void()>& between) override;
  [[nodiscard]] std::uint64_t buffer_bytes() const override;

  /// Returns a view of a mesh that outlives the sink, in the place of begin() to finish().
  [[nodiscard]] GroupedMesh& view(
      ScratchMesh& mesh, const std::function<void()>& between = [] {});
  /// Gives the places of all nodes away, for other views of the mesh (ScratchMesh::curve()).
  /// REQUIRES: view() was called; nodes were placed here; nothing is asked of the mesh afterwards.
  [[nodiscard]] PagedArray<Position> take_nodes();
  /// REQUIRES: finished.
  [[nodiscard]] GroupedMesh& mesh() { return mesh_; }

 private:
  static constexpr std::size_t kSortBytes = 8 << 20;
  /// Side << 32 | first, second, 4 * tet + opposite corner of the first, and of the second.
  using Facets = ExternalSort<4>;

  /// By tet as it came: twice its number in the mesh, and 1 more if its corners 2 and 3 were
  /// swapped.
  using Numbers = PagedFile<std::uint64_t>;

  [[nodiscard]] ScratchMesh& source() { return *mesh_.source_; }
  void group(const std::function<void()>& between);
  void look_at_vertices();
  void look_at_labels();
  [[nodiscard]] Numbers place_tets(const std::function<void()>& between);
  [[nodiscard]] bool place_tet(TetRows tet, std::uint64_t number);
  [[nodiscard]] Facets sort_facets(Numbers numbers, const std::function<void()>& between);
  [[nodiscard]] Facets::Record record_of(const MeshFacet& facet, Numbers& numbers);
  void number_facets(Facets facets);
  void find_wedges();
  void add_wedges(const FacetGroup& group, bool is_first_bottom);
  void find_middles();
  [[nodiscard]] PagedArray<Position> given_nodes();

  std::filesystem::path folder_;
  GroupedMesh mesh_;
  ScratchMesh own_;  ///< what came from begin() to finish()
  WriteGrouped write_;
  std::optional<CurveRule> curves_;
  bool is_in_parts_ = false;                            ///< the mesh is curved as it comes
  std::optional<CurvedParts> parts_;                    ///< of such a mesh
  std::optional<ScratchMesh> from_parts_;               ///< corners of parts_
  std::optional<PagedArray<SixPlaces>> given_middles_;  ///< of parts_, by tet
  std::optional<PagedArray<Position>> own_nodes_;       ///< curved ones that the mesh had not
};

}  // namespace mw::io
