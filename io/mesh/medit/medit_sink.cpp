// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Streams a mesh into an ASCII MEDIT .mesh file.
#include "io/mesh/medit/medit_sink.h"

#include <array>
#include <charconv>

#include "io/file/errors.h"
#include "io/mesh/sink_counts.h"
#include "kernels/core/assert.h"

namespace mw::io {
namespace {

/// One line of numbers; room for five of the longest.
class Line {
 public:
  template <class T>
  void add(T number) {
    end_ = std::to_chars(end_, chars_.data() + chars_.size(), number).ptr;
    *end_++ = ' ';
  }
  /// The line, its last blank turned into the line's end.
  [[nodiscard]] std::string_view finish() {
    end_[-1] = '\n';
    return {chars_.data(), static_cast<std::size_t>(end_ - chars_.data())};
  }

 private:
  std::array<char, 160> chars_;
  char* end_ = chars_.data();
};

}  // namespace

void MeditSink::begin(const MeshHeader& header) {
  header_ = header;
  file_.append(text("MeshVersionFormatted 2\nDimension 3\nVertices\n", header.vertices, "\n"));
}

void MeditSink::write_vertices(std::span<const Position> positions) {
  for (const Position& position : positions) {
    Line line;
    for (const double x : position) line.add(x);
    line.add(0);
    file_.append(line.finish());
  }
  vertices_ += positions.size();
}

void MeditSink::begin_tets() {
  if (tets_begun_) return;
  tets_begun_ = true;
  file_.append(text("Tetrahedra\n", header_.tets, "\n"));
}

void MeditSink::write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) {
  MW_ASSERT(tets.size() == labels.size());
  begin_tets();
  for (std::size_t i = 0; i < tets.size(); ++i) {
    Line line;
    for (const std::uint64_t row : tets[i]) line.add(row + 1);
    if (header_.labels_signed) {
      line.add(static_cast<std::int64_t>(labels[i]));
    } else {
      line.add(labels[i]);
    }
    file_.append(line.finish());
  }
  tets_ += tets.size();
}

void MeditSink::finish() {
  check_sink_counts(name_, header_, vertices_, tets_);
  begin_tets();
  file_.append("End\n");
  file_.commit();
}

}  // namespace mw::io
