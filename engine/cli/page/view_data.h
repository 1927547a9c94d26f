// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The surfaces that a page carries for its view in three dimensions.
#pragma once

#include "engine/cli/page/html_text.h"
#include "io/json/json.h"
#include "io/mesh/grouped/grouped_mesh.h"

namespace mw::cli {

/// The most triangles of a page, which are some 12 MB of it.
inline constexpr std::uint64_t kMaxViewTriangles = 600'000;
/// The most labels of a page: each of them takes a pass when a cut is drawn.
inline constexpr std::size_t kMaxViewLabels = 1000;

/// The largest labels that fit, each with all of its facets.
/// The surrounding label (picture::surrounding_label) is chosen last, as it hides the others.
class ViewData {
 public:
  /// The mesh outlives it; surrounding may be empty.
  /// Memory: 24 bytes a triangle in the view, and 16 a group of facets.
  ViewData(io::GroupedMesh& mesh, std::optional<Label> surrounding);

  /// Return the ranks of the labels that are shown, ascending, and how many are not.
  [[nodiscard]] const std::vector<Label>& labels() const { return labels_; }
  [[nodiscard]] std::size_t left_out() const { return mesh_.table().size() - labels_.size(); }
  [[nodiscard]] std::uint64_t triangles() const { return triangles_; }

  /// Returns "lo" and "hi", the corners that numbers of vertices from 0 to 65535 count between;
  /// "box" with its "origin" and "edges"; and "groups" in the order of the triangles, each with the
  /// indices of its two labels in labels() (-1 if not there) and its number of triangles.
  [[nodiscard]] io::Json json() const;
  /// Writes three 16-bit numbers for each vertex, little endian, in base64.
  void write_vertices(const AppendText& append);
  /// Writes three 32-bit numbers of vertices for each triangle, little endian, in base64.
  void write_triangles(const AppendText& append);

 private:
  void choose(std::optional<Label> surrounding);
  void collect_rows();
  [[nodiscard]] std::int64_t index(Label rank) const;

  io::GroupedMesh& mesh_;
  std::vector<Label> labels_;
  std::vector<io::FacetGroup> groups_;
  std::vector<std::uint64_t> rows_;  ///< of the vertices in the view, ascending
  std::uint64_t triangles_ = 0;
  io::Position lo_{}, hi_{};
};

}  // namespace mw::cli
