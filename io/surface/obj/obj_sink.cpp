// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes a surface as a Wavefront .obj file, with its colours beside.
#include "io/surface/obj/obj_sink.h"

#include <algorithm>
#include <set>

#include "io/file/commit_together.h"
#include "io/file/errors.h"

namespace mw::io {
namespace {

/// One word: blanks end names, and '#' begins a comment.
std::string word_of(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == ' ' || c == '#'; }, '_');
  return name;
}

}  // namespace

ObjSink::ObjSink(const std::filesystem::path& path)
    : materials_path_(std::filesystem::path(path).replace_extension(".mtl")), file_(path) {}

void ObjSink::begin(const SurfaceHeader& header) {
  header_ = header;
  cursor_.emplace(header_);
  colours_ = has_colours(header);
  if (colours_) file_.append(text("mtllib ", materials_path_.filename().string(), "\n"));
}

void ObjSink::write_vertices(std::span<const Position> positions) {
  for (const auto& [x, y, z] : positions) file_.append(text("v ", x, " ", y, " ", z, "\n"));
}

void ObjSink::append_group() {
  const SurfaceRun& run = cursor_->run();
  const std::vector<std::string>& titles = header_.labels->titles;
  const std::string inside = word_of(titles[run.inside]);
  std::string group = inside;
  if (!cursor_->shell().label && run.side == Side::kInterface) {
    group += "|" + word_of(titles[run.outside]);
  }
  if (group == group_) return;
  group_ = group;
  file_.append(text("g ", group, "\n"));
  if (colours_) file_.append(text("usemtl ", inside, "\n"));
}

void ObjSink::write_triangles(std::span<const Triangle> triangles) {
  for (const auto& [a, b, c] : triangles) {
    if (cursor_->next()) append_group();
    file_.append(text("f ", a + 1, " ", b + 1, " ", c + 1, "\n"));
  }
}

void ObjSink::append_materials(AtomicFile& file) {
  std::set<Label> inside;
  for (const SurfaceShell& shell : header_.shells) {
    for (const SurfaceRun& run : shell.runs) inside.insert(run.inside);
  }
  for (const Label rank : inside) {
    const Colour colour = header_.labels->colour(rank);
    file.append(text("newmtl ", word_of(header_.labels->titles[rank]), "\nKd"));
    for (std::size_t i = 0; i < 3; ++i) file.append(text(" ", colour[i] / 255.0));
    file.append(text("\nd ", colour[3] / 255.0, "\n"));
  }
}

void ObjSink::finish() {
  if (!colours_) return file_.commit();
  AtomicFile materials(materials_path_);
  append_materials(materials);
  commit_together({materials, file_});
}

}  // namespace mw::io
