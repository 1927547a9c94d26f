// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes surfaces as binary .stl files.
#include "io/surface/stl_sink.h"

#include <cmath>
#include <limits>

#include "io/file/errors.h"
#include "io/surface/surface_names.h"
#include "kernels/core/vector3.h"

namespace mw::io {
namespace {

/// The title must not begin with "solid", by which readers know the text kind of .stl.
constexpr std::string_view kTitle = "mwmesh: binary STL";
constexpr std::size_t kTitleBytes = 80;

/// Returns the normal of length 1; 0 0 0 where the corners are on one line.
Position normal_of(const std::array<Position, 3>& corners) {
  Position n = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
  const double length = std::hypot(n[0], n[1], n[2]);
  for (double& x : n) x = length > 0 ? x / length : 0;
  return n;
}

void append_floats(AtomicFile& file, const Position& p) {
  for (const double x : p) append_little(file, static_cast<float>(x));
}

/// Returns the text of the header: what it must say, then what the labels are called, as far as
/// there is room.
std::string stl_title(std::string_view file, const SurfaceHeader& header) {
  std::string title(kTitle);
  for (const std::string& comment : {shift_comment(header), space_comment(header)}) {
    if (!comment.empty()) title += "; " + comment;
  }
  if (title.size() > kTitleBytes) {
    fail_usage(file, ": no room for '", title, "' in the ", kTitleBytes,
               " bytes of the header; give --shift with fewer digits");
  }
  std::string between = "; ";
  for (const std::string& name : shell_names(header)) {
    if (title.size() + between.size() + name.size() > kTitleBytes) break;
    title += between + name;
    between = ", ";
  }
  title.resize(kTitleBytes, ' ');
  return title;
}

}  // namespace

StlSink::StlSink(const std::filesystem::path& path)
    : name_(path.string()), file_(path), vertices_(scratch_folder()) {}

void StlSink::begin(const SurfaceHeader& header) {
  const std::uint64_t count = header.triangles();
  check_max(name_, "triangles", count, std::numeric_limits<std::uint32_t>::max());
  check_floats(name_, header, 1, "give --shift X,Y,Z, a place near the mesh, or write .ply");
  file_.append(stl_title(name_, header));
  append_little(file_, static_cast<std::uint32_t>(count));
}

void StlSink::write_vertices(std::span<const Position> positions) {
  for (const Position& p : positions) vertices_.append(p);
}

void StlSink::write_triangles(std::span<const Triangle> triangles) {
  for (const Triangle& triangle : triangles) {
    std::array<Position, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) corners[i] = vertices_[triangle[i]];
    append_floats(file_, normal_of(corners));
    for (const Position& corner : corners) append_floats(file_, corner);
    append_little(file_, std::uint16_t{0});
  }
}

}  // namespace mw::io
