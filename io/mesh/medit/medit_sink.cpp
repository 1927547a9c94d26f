// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Streams a mesh into an ASCII MEDIT .mesh file, with names of labels as its comments.
#include "io/mesh/medit/medit.h"

#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/labels/label_table.h"
#include "io/mesh/mesh_sink.h"
#include "io/names/colour_table.h"
#include "kernels/core/assert.h"

namespace mw::io {
namespace {

constexpr std::string_view kHead = "MeshVersionFormatted 2\nDimension 3\n";
/// Room for any number of vertices, which is known last.
constexpr std::size_t kCountWidth = 20;

constexpr std::string_view kWord = "label ";

/// Takes the name up to the quote that closes it; what is behind it stays in `rest`.
std::optional<std::string> take_name(std::string_view& rest) {
  std::string name;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (rest[i] == '"') {
      rest.remove_prefix(i + 1);
      return name;
    }
    if (rest[i] == '\\') ++i;
    if (i < rest.size()) name.push_back(rest[i]);
  }
  return std::nullopt;
}

/// Reads a colour of four numbers; returns nothing where it is none.
std::optional<Colour> parse_colour(std::string_view numbers) {
  const std::vector<std::string_view> words = words_of(numbers);
  if (words.size() != 4) return std::nullopt;
  Colour colour{};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto byte = byte_of(words[i]);
    if (!byte) return std::nullopt;
    colour[i] = *byte;
  }
  return colour;
}

}  // namespace

void MeditSink::begin(const MeshHeader& header) {
  header_ = header;
  file_.append(kHead);
  if (const std::string record = record_text(header.record); !record.empty()) {
    file_.append(text("# ", kRecordName, " ", record, "\n"));
  }
  for (const LabelName& row : header.names.rows()) {
    file_.append(medit_comment(row, header.labels_signed));
  }
  file_.append("Vertices\n");
  count_at_ = file_.appended();
  file_.append(std::string(kCountWidth, ' ') + "\n");
}

void MeditSink::write_vertices(std::span<const Position> positions) {
  for (const Position& position : positions) {
    NumberLine line;
    for (const double x : position) line.add(x);
    line.add(0);
    file_.append(line.finish());
  }
  vertices_ += positions.size();
}

void MeditSink::write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) {
  MW_ASSERT(tets.size() == labels.size());
  for (std::size_t i = 0; i < tets.size(); ++i) {
    NumberLine line;
    for (const std::uint64_t row : tets[i]) line.add(row + 1);
    if (header_.labels_signed) {
      line.add(static_cast<std::int64_t>(labels[i]));
    } else {
      line.add(labels[i]);
    }
    tet_lines_.append(line.finish());
  }
  tets_ += tets.size();
}

void MeditSink::finish() {
  check_sink_counts(name_, header_, tets_);
  file_.append(text("Tetrahedra\n", header_.tets, "\n"));
  tet_lines_.copy_to(file_, 0, tet_lines_.size());
  file_.append("End\n");
  std::string count = std::to_string(vertices_);
  count.insert(0, kCountWidth - count.size(), ' ');
  file_.write_at(count_at_, std::as_bytes(std::span(count)));
  file_.commit();
}

std::string medit_comment(const LabelName& row, bool is_signed) {
  std::string line = text("# ", kWord, label_text(row.label, is_signed), " \"");
  for (const char c : row.name) {
    if (c == '"' || c == '\\') line += '\\';
    line += c;
  }
  line += '"';
  if (row.colour) {
    for (const std::uint8_t part : *row.colour) line += text(" ", part);
  }
  return line + "\n";
}

std::optional<LabelName> parse_medit_comment(std::string_view comment) {
  comment = trimmed(comment);
  if (!comment.starts_with(kWord)) return std::nullopt;
  const std::size_t quote = comment.find('"');
  if (quote == std::string_view::npos) return std::nullopt;
  const auto label = label_of(comment.substr(kWord.size(), quote - kWord.size()));
  std::string_view rest = comment.substr(quote + 1);
  const auto name = take_name(rest);
  if (!label || !name) return std::nullopt;
  const bool has_colour = !trimmed(rest).empty();
  const auto colour = parse_colour(rest);
  if (has_colour && !colour) return std::nullopt;
  return LabelName{*label, *name, colour};
}

}  // namespace mw::io
