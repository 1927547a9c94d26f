// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers in formats that have smaller ones: those of labels of 64 bits, of nodes and of elements.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "io/file/sink/atomic_file.h"
#include "io/mesh/grouped/grouped_mesh.h"
#include "io/mesh/mesh_extras.h"

namespace mw::io {

/// The numbers that a format can hold, both ends included; min is 0 or 1.
struct NumberRange {
  std::int64_t min = 1;
  std::int64_t max = 2147483647;
};

/// Labels that a format can hold keep their number.  The others get, in their order, the smallest
/// numbers above those, and where none is left above, the free ones below.
class LabelNumbers {
 public:
  /// ERRORS: mw::Error(kUsage) when there are more labels than numbers.
  LabelNumbers(const LabelTable& table, NumberRange range = {});

  /// Returns the number of a label, by its rank.
  [[nodiscard]] std::int64_t operator[](Label rank) const { return numbers_[rank]; }
  /// Returns the largest number, or 0 where there are no labels.
  [[nodiscard]] std::int64_t largest() const { return largest_; }

 private:
  std::vector<std::int64_t> numbers_;
  std::int64_t largest_ = 0;
};

/// The largest number of a node or element in a format.
struct NumberLimit {
  std::uint64_t max = 0;
  const char* subject = "";  ///< who has it, as "Abaqus has"
  const char* others = "";   ///< the formats that have larger ones, as ".msh or .vtkhdf"
};

/// ERRORS: mw::Error(kUsage) naming the file where `largest` is above the limit.
void check_number(std::string_view file, std::uint64_t largest, const NumberLimit& limit);

/// How a format rounds coordinates.
struct Rounding {
  double largest = 0;        ///< coordinate, without its sign
  double shortest_edge = 0;  ///< in the same unit
  double loss = 0;           ///< the most that a coordinate moves
  std::string room;          ///< what the format has for one, as "10 digits"
  std::string way_out;
};

/// ERRORS: mw::Error(kUsage) naming the file where nodes move by more than a 64th of the shortest
/// edge: tets and triangles lose their shape then.
void check_rounding(std::string_view file, const Rounding& rounding);

/// Checks the rounding of coordinates of `digits` significant digits.
void check_digits(std::string_view file, const GroupedMesh& mesh, int digits);

/// Returns the path of the table that lies beside a mesh: MESH.labels.csv.
[[nodiscard]] std::filesystem::path label_table_path(const std::filesystem::path& mesh);

/// Appends the content of that table, with the columns id (the label), number (in the mesh), name,
/// r, g, b, a, and for each mask mask_NAME, which is 1 for its labels and 0 for others.  It is a
/// table of names too (parse_csv_names).  The file is to be committed with the mesh
/// (commit_together()).  ERRORS: see AtomicFile.
void append_label_table(AtomicFile& file, const LabelTable& table, const MeshHeader& header,
                        const LabelNumbers& numbers);

/// A text file with that table beside it, for writers of formats.  ERRORS: see AtomicFile.
class TabledFile {
 public:
  TabledFile(const std::filesystem::path& path, const MeshExtras& more)
      : name(path.string()), extras(more), text_(path), labels_(label_table_path(path)) {}

  void line(std::string_view line) { text_.append_line(line); }
  void append(std::string_view text) { text_.append(text); }
  /// Writes the table and commits both files.
  void commit(const GroupedMesh& mesh, const LabelNumbers& numbers);

  const std::string name;
  const MeshExtras extras;

 private:
  AtomicFile text_;
  AtomicFile labels_;
};

/// What such a table says.
struct LabelMap {
  std::map<std::int64_t, RawLabel> labels;  ///< by number
  bool labels_signed = false;               ///< one of them is negative
  LabelNames names;
};

/// Reads the table beside a mesh; returns nothing where there is none.
/// ERRORS: mw::Error(kInput) naming file and line.
[[nodiscard]] std::optional<LabelMap> read_label_table(const std::filesystem::path& mesh);

/// Turns the numbers in a mesh file into labels by the table beside it; where there is none, the
/// numbers are the labels.
class NumberedLabels {
 public:
  explicit NumberedLabels(const std::filesystem::path& mesh);

  /// ERRORS: mw::Error(kInput) when the table does not know the number.
  [[nodiscard]] RawLabel label(std::int64_t number);
  /// Returns whether labels are signed; without a table, whether a number was negative.
  [[nodiscard]] bool labels_signed() const { return map_ ? map_->labels_signed : negative_; }
  [[nodiscard]] bool has_table() const { return map_.has_value(); }
  [[nodiscard]] LabelNames names() const { return map_ ? map_->names : LabelNames{}; }

 private:
  std::filesystem::path mesh_;
  std::optional<LabelMap> map_;
  bool negative_ = false;
};

}  // namespace mw::io
