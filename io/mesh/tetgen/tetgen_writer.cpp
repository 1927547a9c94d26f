// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes a mesh as TetGen's .node, .ele and .face files.
#include "io/mesh/tetgen/tetgen_writer.h"

#include "io/file/commit_together.h"
#include "io/file/errors.h"
#include "io/mesh/grouped/facet_numbers.h"
#include "io/mesh/grouped/label_numbers.h"
#include "io/mesh/number_line.h"

namespace mw::io {
namespace {

/// Where in kTetEdges each edge of TetGen's order is.
constexpr std::array<std::size_t, 6> find_edges() {
  std::array<std::size_t, 6> out{};
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
      const auto [a, b] = kTetEdges[e];
      const auto [c, d] = kTetgenEdges[i];
      if ((a == c && b == d) || (a == d && b == c)) out[i] = e;
    }
  }
  return out;
}

constexpr std::array<std::size_t, 6> kEdgeOf = find_edges();

}  // namespace

std::filesystem::path tetgen_tets_path(const std::filesystem::path& nodes) {
  return std::filesystem::path(nodes).replace_extension(".ele");
}

std::filesystem::path tetgen_facets_path(const std::filesystem::path& nodes) {
  return std::filesystem::path(nodes).replace_extension(".face");
}

TetgenWriter::TetgenWriter(const std::filesystem::path& path)
    : nodes_(path),
      tets_(tetgen_tets_path(path)),
      facets_(tetgen_facets_path(path)),
      label_table_(label_table_path(path)),
      facet_table_(facet_table_path(path)) {}

void TetgenWriter::write(GroupedMesh& mesh) {
  write_nodes(mesh);
  write_tets(mesh);
  write_facets(mesh);
  commit_together({label_table_, facet_table_, tets_, facets_, nodes_});
}

void TetgenWriter::write_nodes(GroupedMesh& mesh) {
  nodes_.append(text(mesh.node_count(), " 3 0 0\n"));
  for (std::uint64_t row = 0; row < mesh.node_count(); ++row) {
    NumberLine line;
    line.add(row + 1);
    for (const double x : mesh.node(row)) line.add(x);
    nodes_.append(line.finish());
  }
}

void TetgenWriter::write_tets(GroupedMesh& mesh) {
  const LabelNumbers numbers(mesh.table(), {.min = 0});
  const bool ten = mesh.element() == Element::kTet10;
  tets_.append(text(mesh.tet_count(), " ", node_count(mesh.element()), " 1\n"));
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    const RowRange range = mesh.label_tets()[rank];
    for (std::uint64_t tet = range.begin; tet < range.end; ++tet) {
      NumberLine line;
      line.add(tet + 1);
      for (const std::uint64_t row : mesh.tet(tet)) line.add(row + 1);
      if (ten) {
        const std::array<std::uint64_t, 6> middles = mesh.middles(tet);
        for (const std::size_t edge : kEdgeOf) line.add(middles[edge] + 1);
      }
      line.add(numbers[rank]);
      tets_.append(line.finish());
    }
  }
  append_label_table(label_table_, mesh.table(), mesh.names(), numbers);
}

void TetgenWriter::write_facets(GroupedMesh& mesh) {
  const std::vector<NumberedFacets> runs = number_facets(mesh);
  const bool ten = mesh.element() == Element::kTet10;
  facets_.append(text(mesh.facet_count(), " 1\n"));
  for (const NumberedFacets& run : runs) {
    for (std::uint64_t number = run.facets.begin; number < run.facets.end; ++number) {
      NumberLine line;
      line.add(number + 1);
      const Facet facet = mesh.facet(number);
      for (const std::uint64_t row : facet.rows) line.add(row + 1);
      if (ten) {
        for (const std::uint64_t row : mesh.facet_middles(facet)) line.add(row + 1);
      }
      line.add(run.number);
      facets_.append(line.finish());
    }
  }
  append_facet_table(facet_table_, mesh.table(), runs);
}

}  // namespace mw::io
