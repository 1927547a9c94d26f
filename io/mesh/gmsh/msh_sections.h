// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads the sections of .msh files in both versions, from text or from bytes, into one content,
// whose nodes have numbers of any kind.
#pragma once

#include <limits>
#include <map>

#include "io/file/byte_order.h"
#include "io/file/errors.h"
#include "io/file/source/byte_source.h"
#include "io/mesh/mesh_data.h"

namespace mw::io {

/// Takes nodes and tets in any order, and then turns the numbers of nodes into rows.
class TaggedMesh {
 public:
  /// file is what errors call the mesh.
  explicit TaggedMesh(std::string file) : file_(std::move(file)) {}

  void add_node(std::uint64_t tag, const Position& position) { nodes_.push_back({tag, position}); }
  /// tags holds four corners, and behind them any number of nodes on edges, faces and inside.
  /// mark is the caller's, and becomes the label.  REQUIRES: tags.size() >= 4.
  void add_tet(std::span<const std::uint64_t> tags, RawLabel mark);

  [[nodiscard]] std::uint64_t node_count() const { return nodes_.size(); }
  [[nodiscard]] std::uint64_t tet_count() const { return mesh_.tets.size(); }
  /// Returns the marks, by tet.
  [[nodiscard]] std::vector<RawLabel>& marks() { return mesh_.labels; }

  /// ENSURES: rows are nodes by ascending number, without those that are in tets but are a corner
  /// of none; tets have the order in which they came.  Nothing is left here.
  /// ERRORS: mw::Error(kInput) when a tet names a node that never came, or two have one number.
  [[nodiscard]] MeshData finish();

 private:
  struct Node {
    std::uint64_t tag = 0;
    Position position{};
  };

  void sort_nodes();
  [[nodiscard]] std::uint64_t row_of(std::uint64_t tag) const;

  std::string file_;
  std::vector<Node> nodes_;
  std::vector<std::uint64_t> middles_;  ///< tags of nodes that are no corner of their tet
  MeshData mesh_;                       ///< its tets hold tags, which finish() turns into rows
};

/// ERRORS (all members): mw::Error(kInput) with file, line or byte, and what was expected.
class MshInput {
 public:
  explicit MshInput(const ByteSource& source) : cursor_(source) {}

  [[nodiscard]] bool ascii() const { return ascii_; }
  [[nodiscard]] const std::string& name() const { return cursor_.source().name(); }
  /// Makes the numbers that follow be read as bytes.
  void set_binary(ByteOrder order);
  /// Returns the next line that is not blank, without blanks at its ends.  It is valid until the
  /// next call of any member.
  [[nodiscard]] std::string_view next_line(std::string_view expected);
  /// Returns the name of the section that begins here, as "Nodes"; empty at the end of the file.
  [[nodiscard]] std::string next_section();
  /// Reads the line "$End<section>", which must come here.
  void end_section(std::string_view section);
  /// Skips all up to and including that line.
  void skip_section(std::string_view section);
  /// Skips as much, and returns whether that line came before the end of the file.
  [[nodiscard]] bool find_end(std::string_view section);

  /// Reads an integer, of 32 bits in binary.
  [[nodiscard]] std::int64_t integer(std::string_view expected);
  /// Reads a number that is not negative, of 64 bits in binary.
  [[nodiscard]] std::uint64_t count(std::string_view expected);
  /// Reads a finite number.
  [[nodiscard]] double real(std::string_view expected);
  /// Reads a number, finite or not.
  [[nodiscard]] double real_or_nan(std::string_view expected);
  /// Skips reals that do not matter, finite or not.
  void skip_reals(std::int64_t how_many);
  /// Fails unless the rest of the file can hold these rows, of at least `bytes` bytes each in
  /// binary or `numbers` numbers in text, so that a damaged count cannot ask for all memory.
  void check_rows(std::uint64_t rows, std::uint64_t bytes, std::uint64_t numbers) const;

  [[noreturn]] void fail(std::string_view reason) const;

 private:
  [[nodiscard]] std::string_view word();
  [[noreturn]] void fail_word(std::string_view expected) const;
  template <class T>
  [[nodiscard]] T from_bytes(std::string_view expected);

  ByteCursor cursor_;
  std::string text_;        ///< the last word or line
  std::uint64_t line_ = 1;  ///< line where that began
  bool ascii_ = true;
  ByteOrder order_ = kHostOrder;
};

/// What the sections hold.  The mark of a tet is a number, in version 4 that of its entity.
struct MshContent {
  explicit MshContent(const std::string& file) : mesh(file) {}

  TaggedMesh mesh;
  std::map<std::int64_t, std::int64_t> physical_of;  ///< by volume, if in one
  std::map<std::int64_t, std::string> names;         ///< those of physical volumes
  std::uint64_t elements = 0;                        ///< number of elements of all types
  MeshRecord record;                                 ///< what a comment tells, or nothing
  std::vector<std::uint64_t> numbers{};              ///< those of tets as elements
  std::vector<TetValues> values{};                   ///< under the names in the file
};

// ERRORS (all functions): see MshInput.

/// Returns the number of a physical group, whose sign tells the orientation.
[[nodiscard]] inline std::int64_t without_sign(const MshInput& in, std::int64_t group) {
  if (group == std::numeric_limits<std::int64_t>::min()) {
    in.fail(text(group, " is no number of a physical group"));
  }
  return group < 0 ? -group : group;
}

/// Read a section of version 4.1, from behind its first line, such as "$Entities", to its last.
void read_msh4_entities(MshInput& in, MshContent& out);
void read_msh4_nodes(MshInput& in, MshContent& out);
void read_msh4_elements(MshInput& in, MshContent& out);

/// Read a section of version 2.2, which many tools still write; marks are physical groups, or
/// entities where there is none.
void read_msh2_nodes(MshInput& in, MshContent& out);
void read_msh2_elements(MshInput& in, MshContent& out);

/// Reads the sections behind the elements in both versions: from each ElementData with one
/// component the values of tets, NaN for a tet without one.  Sections without a value for any tet
/// are left out, and so are those beyond kMostValues.
void read_msh_values(MshInput& in, MshContent& out);

}  // namespace mw::io
