// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads an ASCII MEDIT .mesh file.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/errors.h"
#include "io/file/source/byte_source.h"
#include "io/file/text_numbers.h"
#include "io/mesh/medit/medit.h"
#include "io/mesh/mesh_record.h"

namespace mw::io {
namespace {

/// No number or keyword is that long; the bound keeps memory small on binary files.
constexpr std::size_t kMaxWordBytes = 256;
/// No comment with a name is that long.
constexpr std::size_t kMaxNameCommentBytes = 1 << 13;

/// Reads words, which are separated by blanks, tabs and line ends of any kind; '#' begins a comment
/// up to the end of its line.
class TokenScanner {
 public:
  explicit TokenScanner(const ByteSource& source) : cursor_(source) {}
  /// Makes take get each comment that follows, without its '#' and line end, cut at
  /// kMaxRecordBytes.
  void on_comment(std::function<void(std::string_view)> take) { take_comment_ = std::move(take); }

  /// Returns the next word, or nothing at the end.  It is valid until the next call.
  [[nodiscard]] std::string_view next();
  /// ERRORS (also below): mw::Error(kInput) with file, line and what was expected.
  [[nodiscard]] double next_real(std::string_view expected);
  [[nodiscard]] std::uint64_t next_count(std::string_view expected);
  /// Reads an integer in -2^63 .. 2^64-1, as two's complement; negative tells the sign.
  [[nodiscard]] std::uint64_t next_integer(std::string_view expected, bool& negative);
  [[noreturn]] void fail(std::string_view reason) const;

 private:
  void skip_blanks();
  void skip_comment();
  [[noreturn]] void fail_word(std::string_view expected, std::string_view word) const;

  ByteCursor cursor_;
  std::string word_;
  std::function<void(std::string_view)> take_comment_;
};

void TokenScanner::skip_blanks() {
  for (int c = cursor_.peek(); c >= 0 && (is_blank(c) || c == '#'); c = cursor_.peek()) {
    c == '#' ? skip_comment() : cursor_.take();
  }
}

/// Skips a comment up to its line end, which it leaves.
void TokenScanner::skip_comment() {
  std::string comment;
  cursor_.take();
  for (int c = cursor_.peek(); c >= 0 && c != '\n'; c = cursor_.peek()) {
    if (comment.size() < kMaxRecordBytes) comment.push_back(static_cast<char>(c));
    cursor_.take();
  }
  if (take_comment_) take_comment_(comment);
}

std::string_view TokenScanner::next() {
  skip_blanks();
  word_.clear();
  for (int c = cursor_.peek(); c >= 0 && !is_blank(c) && c != '#'; c = cursor_.peek()) {
    if (word_.size() == kMaxWordBytes) fail("not an ASCII mesh file");
    word_.push_back(static_cast<char>(c));
    cursor_.take();
  }
  return word_;
}

double TokenScanner::next_real(std::string_view expected) {
  const std::string_view word = next();
  const std::optional<double> number = parse_real(word);
  if (!number || !std::isfinite(*number)) fail_word(expected, word);
  return *number;
}

std::uint64_t TokenScanner::next_count(std::string_view expected) {
  bool negative = false;
  const std::uint64_t number = next_integer(expected, negative);
  if (negative) fail_word(expected, word_);
  return number;
}

std::uint64_t TokenScanner::next_integer(std::string_view expected, bool& negative) {
  const std::string_view word = next();
  negative = word.starts_with('-');
  if (const auto below = negative ? parse_integer(word) : std::nullopt) {
    return static_cast<std::uint64_t>(*below);
  }
  if (const auto above = parse_count(word)) return *above;
  fail_word(expected, word);
}

void TokenScanner::fail_word(std::string_view expected, std::string_view word) const {
  if (word.empty()) fail(text("truncated: the file ends where ", expected, " is expected"));
  fail(text("'", word, "' stands where ", expected, " is expected"));
}

void TokenScanner::fail(std::string_view reason) const {
  fail_input(cursor_.source().name(), text("line ", cursor_.line()), reason, "write the mesh anew");
}

constexpr std::string_view kRecord = " mwmesh ";

/// Reads a count that the file can hold, so that a damaged one cannot ask for all memory.
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
    const bool may_be_name = comment.size() < kMaxNameCommentBytes;
    if (auto row = may_be_name ? parse_medit_comment(comment) : std::nullopt) {
      names.push_back(std::move(*row));
    }
    if (comment.starts_with(kRecord)) {
      mesh.record = parse_record(comment.substr(kRecord.size()), source.name());
    }
  });
  if (scanner.next() != "MeshVersionFormatted") scanner.fail("not a MEDIT file");
  bool vertices = false;
  bool tets = false;
  // Words that are no keyword are rows of a section that is skipped.
  for (std::string_view word = scanner.next(); word != "End"; word = scanner.next()) {
    // Without that word the last number of all could have been cut.
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
