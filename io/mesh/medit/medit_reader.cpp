// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads an ASCII MEDIT .mesh file.
#include "io/mesh/medit/medit_reader.h"

#include "io/file/errors.h"
#include "io/mesh/medit/medit_names.h"
#include "io/mesh/medit/token_scanner.h"

namespace mw::io {
namespace {

constexpr std::string_view kRecord = " mwmesh ";

/// A count that the file could hold, so that a damaged one cannot ask for all memory.
std::uint64_t next_rows(TokenScanner& scanner, const ByteSource& source, std::uint64_t min_bytes) {
  const std::uint64_t rows = scanner.next_count("a number of rows");
  const std::uint64_t min = saturating_product(rows, min_bytes);
  const std::uint64_t size = source.size_within(min);
  if (size < min) {
    scanner.fail(text(rows, " rows are announced, the file of ", size, " bytes cannot hold them"));
  }
  return rows;
}

void read_vertices(TokenScanner& scanner, std::uint64_t rows, MeshData& mesh) {
  mesh.vertices.resize(rows);
  for (Position& position : mesh.vertices) {
    for (double& x : position) x = scanner.next_real("a coordinate");
    bool negative = false;
    static_cast<void>(scanner.next_integer("the reference of a vertex", negative));
  }
}

void read_tets(TokenScanner& scanner, std::uint64_t rows, MeshData& mesh) {
  mesh.tets.resize(rows);
  mesh.labels.resize(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::uint64_t& row : mesh.tets[i]) {
      row = scanner.next_count("a vertex of a tetrahedron") - 1;  // 0 wraps: refused below
      if (row >= mesh.vertices.size()) {
        scanner.fail(text("tetrahedron ", i + 1, " names vertex ", row + 1, ", there are ",
                          mesh.vertices.size()));
      }
    }
    bool negative = false;
    mesh.labels[i] = scanner.next_integer("the reference of a tetrahedron", negative);
    mesh.labels_signed = mesh.labels_signed || negative;
  }
}

bool is_keyword(std::string_view word) {
  const int first = word.empty() ? 0 : word[0] | 0x20;
  return first >= 'a' && first <= 'z' && word != "nan" && word != "inf";
}

}  // namespace

MeshData read_medit(const ByteSource& source) {
  constexpr std::uint64_t kMinVertexBytes = 8, kMinTetBytes = 10;
  TokenScanner scanner(source);
  MeshData mesh;
  std::vector<LabelName> names;
  scanner.on_comment([&](std::string_view comment) {
    if (auto row = parse_medit_comment(comment)) names.push_back(std::move(*row));
    if (comment.starts_with(kRecord)) {
      mesh.record = parse_record(comment.substr(kRecord.size()), source.name());
    }
  });
  if (scanner.next() != "MeshVersionFormatted") scanner.fail("not a MEDIT file");
  bool vertices = false;
  bool tets = false;
  // Words that are no keyword are rows of a section that is skipped.
  for (std::string_view word = scanner.next(); word != "End"; word = scanner.next()) {
    // Without it the last number of all could have been cut.
    if (word.empty()) scanner.fail("truncated: the file ends without the word End");
    if (!is_keyword(word)) continue;
    if (word == "Dimension") {
      if (scanner.next_count("the dimension") != 3) scanner.fail("the dimension is not 3");
    } else if (word == "Vertices" && !vertices) {
      read_vertices(scanner, next_rows(scanner, source, kMinVertexBytes), mesh);
      vertices = true;
    } else if (word == "Tetrahedra" && vertices && !tets) {
      read_tets(scanner, next_rows(scanner, source, kMinTetBytes), mesh);
      tets = true;
    } else if (word == "Vertices" || word == "Tetrahedra") {
      scanner.fail(text("a second or misplaced section ", word));
    }
  }
  if (!vertices || !tets) scanner.fail("no sections Vertices and Tetrahedra");
  mesh.names = LabelNames(std::move(names));
  return mesh;
}

}  // namespace mw::io
