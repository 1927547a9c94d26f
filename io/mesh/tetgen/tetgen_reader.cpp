// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads TetGen's .node and .ele files.
#include "io/mesh/tetgen/tetgen_reader.h"

#include <cmath>

#include "io/file/errors.h"
#include "io/file/open_bytes.h"
#include "io/file/text_numbers.h"
#include "io/mesh/grouped/label_numbers.h"
#include "io/mesh/kept_rows.h"
#include "io/mesh/medit/token_scanner.h"
#include "io/mesh/tetgen/tetgen_writer.h"

namespace mw::io {
namespace {

/// One of the files.
class TetgenFile {
 public:
  explicit TetgenFile(const std::filesystem::path& path)
      : source_(open_bytes(path)), scanner_(*source_) {
    // Without it the last number of all could have been cut.
    std::byte last{};
    if (source_->size() > 0) source_->read_at(source_->size() - 1, std::span(&last, 1));
    if (last != std::byte{'\n'}) {
      fail_input(source_->name(), "end", "truncated: its last line has no end");
    }
  }

  [[nodiscard]] TokenScanner& scanner() { return scanner_; }
  /// A count that the file could hold, so that a damaged one cannot ask for all memory.
  [[nodiscard]] std::uint64_t next_rows() {
    constexpr std::uint64_t kMinRowBytes = 8;
    const std::uint64_t rows = scanner_.next_count("a number of rows");
    if (rows <= source_->size() / kMinRowBytes) return rows;
    scanner_.fail(text(rows, " rows are announced, the file of ", source_->size(),
                       " bytes cannot hold them"));
  }
  /// How many numbers of a kind a row has.
  [[nodiscard]] std::uint64_t next_width(std::string_view of_what) {
    constexpr std::uint64_t kMax = 1000;
    const std::uint64_t width = scanner_.next_count(of_what);
    if (width > kMax) scanner_.fail(text(width, " is no credible ", of_what));
    return width;
  }
  void skip(std::uint64_t words) {
    for (std::uint64_t i = 0; i < words; ++i) {
      static_cast<void>(scanner_.next_real("an attribute or a marker"));
    }
  }
  /// The number of a row, which is that of the one before and one.
  void expect_row(std::uint64_t row) {
    const std::uint64_t found = scanner_.next_count("the number of a row");
    if (found != row) scanner_.fail(text("row ", found, " stands where ", row, " is expected"));
  }

 private:
  std::unique_ptr<ByteSource> source_;
  TokenScanner scanner_;
};

/// Returns the number of the first.
std::uint64_t read_nodes(const std::filesystem::path& path, MeshData& mesh) {
  TetgenFile file(path);
  TokenScanner& scanner = file.scanner();
  const std::uint64_t rows = file.next_rows();
  if (scanner.next_count("the dimension") != 3) scanner.fail("the dimension is not 3");
  const std::uint64_t behind =
      file.next_width("number of attributes") + file.next_width("number of markers");
  mesh.vertices.resize(rows);
  std::uint64_t first = 1;
  for (std::uint64_t row = 0; row < rows; ++row) {
    if (row > 0) {
      file.expect_row(first + row);
    } else {
      first = scanner.next_count("the number of a node");
      if (first > 1) scanner.fail(text("nodes count from ", first, ", not from 0 or 1"));
    }
    for (double& x : mesh.vertices[row]) x = scanner.next_real("a coordinate");
    file.skip(behind);
  }
  return first;
}

/// An attribute is a real number for TetGen.
std::int64_t next_label(TokenScanner& scanner) {
  constexpr double kMaxExact = 9007199254740992.0;  // 2^53
  const std::string word(scanner.next());
  if (const auto integer = parse_integer(word)) return *integer;
  const auto real = parse_real(word);
  if (!real || std::trunc(*real) != *real || std::abs(*real) > kMaxExact) {
    scanner.fail(text("'", word, "' stands where the label of a tet is expected"));
  }
  return static_cast<std::int64_t>(*real);
}

/// Reads tets into a mesh that has its nodes.
class TetRowsReader {
 public:
  TetRowsReader(const std::filesystem::path& nodes, std::uint64_t first, MeshData& mesh)
      : file_(tetgen_tets_path(nodes)),
        scanner_(file_.scanner()),
        numbered_(nodes),
        middles_(mesh.vertices.size()),
        first_(first),
        mesh_(mesh) {}

  void read() {
    const std::uint64_t rows = file_.next_rows();
    nodes_ = scanner_.next_count("number of nodes of a tet");
    if (nodes_ != 4 && nodes_ != 10) scanner_.fail(text("tets of ", nodes_, " nodes, not 4 or 10"));
    attributes_ = file_.next_width("number of attributes");
    if (attributes_ == 0 && rows > 0)
      scanner_.fail("tets have no attribute (tetgen -A) to label them");
    mesh_.tets.resize(rows);
    mesh_.labels.resize(rows);
    for (std::uint64_t tet = 0; tet < rows; ++tet) read_row(tet);
    mesh_.labels_signed = numbered_.labels_signed();
    mesh_.names = numbered_.names();
    drop_middles(mesh_, middles_);
  }

 private:
  void read_row(std::uint64_t tet) {
    file_.expect_row(first_ + tet);
    for (std::uint64_t& row : mesh_.tets[tet]) row = next_node();
    for (std::uint64_t i = 4; i < nodes_; ++i) middles_.middle(next_node());
    mesh_.labels[tet] = numbered_.label(next_label(scanner_));
    file_.skip(attributes_ - 1);
  }

  [[nodiscard]] std::uint64_t next_node() {
    const std::uint64_t row = scanner_.next_count("a node of a tet") - first_;  // may wrap
    if (row < mesh_.vertices.size()) return row;
    scanner_.fail(text("names node ", row + first_, ", there are ", mesh_.vertices.size()));
  }

  TetgenFile file_;
  TokenScanner& scanner_;
  NumberedLabels numbered_;
  KeptRows middles_;
  std::uint64_t first_;
  MeshData& mesh_;
  std::uint64_t nodes_ = 4;
  std::uint64_t attributes_ = 1;
};

}  // namespace

MeshData read_tetgen(const std::filesystem::path& nodes) {
  MeshData mesh;
  const std::uint64_t first = read_nodes(nodes, mesh);
  TetRowsReader(nodes, first, mesh).read();
  return mesh;
}

}  // namespace mw::io
