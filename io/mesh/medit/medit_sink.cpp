// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Streams a mesh into an ASCII MEDIT .mesh file.
#include "io/mesh/medit/medit_sink.h"

#include <algorithm>

#include "io/file/errors.h"
#include "io/mesh/medit/medit_names.h"
#include "io/mesh/number_line.h"
#include "io/mesh/sink_counts.h"
#include "kernels/core/assert.h"

namespace mw::io {
namespace {

constexpr std::string_view kHead = "MeshVersionFormatted 2\nDimension 3\n";
/// Room for any number of vertices, which is known last.
constexpr std::size_t kCountWidth = 20;
constexpr std::uint64_t kCopyBytes = 1 << 18;

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

void MeditSink::append_tets() {
  file_.append(text("Tetrahedra\n", header_.tets, "\n"));
  std::vector<std::byte> bytes;
  for (std::uint64_t at = 0; at < tet_lines_.size(); at += bytes.size()) {
    bytes.resize(std::min(kCopyBytes, tet_lines_.size() - at));
    tet_lines_.read_at(at, bytes);
    file_.append(bytes);
  }
}

void MeditSink::finish() {
  check_sink_counts(name_, header_, tets_);
  append_tets();
  file_.append("End\n");
  std::string count = std::to_string(vertices_);
  count.insert(0, kCountWidth - count.size(), ' ');
  file_.write_at(count_at_, std::as_bytes(std::span(count)));
  file_.commit();
}

}  // namespace mw::io
