// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes surfaces as .obj files.
#include "io/surface/obj_sink.h"

#include "io/file/errors.h"
#include "io/mesh/medit/medit.h"

namespace mw::io {

void ObjSink::begin(const SurfaceHeader& header) {
  header_ = header;
  names_.emplace(header_);
  cursor_.emplace(header_);
  for (const std::string& comment :
       {std::string("mwmesh"), space_comment(header_), shift_comment(header_)}) {
    if (!comment.empty()) file_.append("# " + comment + "\n");
  }
  const bool is_signed = header_.labels->table.is_signed();
  const LabelNames known = names_of(header_);
  for (const LabelName& row : known.rows()) {
    file_.append(medit_comment(row, is_signed));
  }
}

void ObjSink::write_vertices(std::span<const Position> positions) {
  for (const auto& [x, y, z] : positions) file_.append(text("v ", x, " ", y, " ", z, "\n"));
}

void ObjSink::begin_run() {
  const SurfaceShell& shell = cursor_->shell();
  if (!shell.label) {
    file_.append(text("g ", names_->run(cursor_->run()), "\n"));
  } else if (shell_ != &shell) {
    const std::string& name = names_->label(*shell.label);
    file_.append(text("o ", name, "\ng ", name, "\n"));
  }
  shell_ = &shell;
}

void ObjSink::write_triangles(std::span<const Triangle> triangles) {
  for (const auto& [a, b, c] : triangles) {
    if (cursor_->next()) begin_run();
    file_.append(text("f ", a + 1, " ", b + 1, " ", c + 1, "\n"));
  }
}

}  // namespace mw::io
