// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes surfaces as binary .stl and .ply files.
#include "io/surface/open_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/file/sink/atomic_file.h"
#include "io/mesh/grouped/label_numbers.h"
#include "io/mesh/medit/medit.h"
#include "kernels/core/vector3.h"

namespace mw::io {
namespace {

/// Writes 80 bytes of text with shift_comment() and space_comment(), the number of triangles in 32
/// bits, then for each its normal and its corners as 32-bit floats and two bytes of 0.  The format
/// has neither labels nor vertices; readers join the corners that have the same coordinates.
/// Memory: 10 MiB; vertices wait in a temporary file.
class StlSink : public SurfaceSink {
 public:
  explicit StlSink(const std::filesystem::path& path);

  void begin(const SurfaceHeader& header) override;
  void write_vertices(std::span<const Position> positions) override;
  void write_triangles(std::span<const Triangle> triangles) override;
  void finish() override { file_.commit(); }

 private:
  std::string name_;
  AtomicFile file_;
  PagedFile<Position> vertices_;
};

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

StlSink::StlSink(const std::filesystem::path& path)
    : name_(path.string()), file_(path), vertices_(scratch_folder()) {}

void StlSink::begin(const SurfaceHeader& header) {
  const std::uint64_t count = header.triangles();
  check_max(name_, "triangles", count, std::numeric_limits<std::uint32_t>::max());
  check_floats(name_, header, 1, "give --shift X,Y,Z, a place near the mesh, or write .ply");
  std::string title(kTitle);
  for (const std::string& comment : {shift_comment(header), space_comment(header)}) {
    if (!comment.empty()) title += "; " + comment;
  }
  if (title.size() > kTitleBytes) {
    fail_usage(name_, ": no room for '", title, "' in the ", kTitleBytes,
               " bytes of the header; give --shift with fewer digits");
  }
  title.resize(kTitleBytes, ' ');
  file_.append(title);
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

/// Writes little-endian.  Vertices have x y z (double), faces have vertex_indices (int).
/// Surfaces of labels have more on their vertices only, as simple readers expect: label (int), and
/// red green blue (uchar).  Interfaces have more on their faces: label_in, label_out (int; 0 where
/// a face is on no interface), side (uchar, see Side), and red green blue of label_in.
/// Colours are written if that of any label is known.  Comments hold names and colours; labels
/// beyond 31 bits get numbers, and a comment says which.
class PlySink : public SurfaceSink {
 public:
  explicit PlySink(const std::filesystem::path& path) : name_(path.string()), file_(path) {}

  void begin(const SurfaceHeader& header) override;
  void write_vertices(std::span<const Position> positions) override;
  void write_triangles(std::span<const Triangle> triangles) override;
  void finish() override { file_.commit(); }

 private:
  void append_comments();
  void append_number(Label rank);
  void append_colour(Label rank);

  std::string name_;
  AtomicFile file_;
  SurfaceHeader header_;
  std::optional<LabelNumbers> numbers_;
  std::optional<RunCursor> cursor_;
  bool of_labels_ = false;
  bool colours_ = false;
  std::size_t shell_ = 0;           ///< of the next vertex
  std::uint64_t shell_vertex_ = 0;  ///< its number there
};

constexpr std::string_view kColours =
    "property uchar red\nproperty uchar green\nproperty uchar blue\n";
constexpr std::string_view kOnVertices = "property int label\n";
constexpr std::string_view kOnFaces =
    "property int label_in\nproperty int label_out\nproperty uchar side\n";

void PlySink::begin(const SurfaceHeader& header) {
  constexpr std::uint64_t kMax = std::numeric_limits<std::int32_t>::max();
  check_max(name_, "vertices", header.vertices(), kMax);
  header_ = header;
  numbers_.emplace(header.labels->table, NumberRange{.min = 0});
  cursor_.emplace(header_);
  colours_ = has_colours(header);
  of_labels_ = std::all_of(header.shells.begin(), header.shells.end(),
                           [](const SurfaceShell& shell) { return shell.label.has_value(); });
  const std::string_view colours = colours_ ? kColours : "";
  file_.append(std::string_view("ply\nformat binary_little_endian 1.0\n"));
  append_comments();
  file_.append(text("element vertex ", header.vertices(),
                    "\nproperty double x\nproperty double y\nproperty double z\n"));
  if (of_labels_) file_.append(text(kOnVertices, colours));
  file_.append(
      text("element face ", header.triangles(), "\nproperty list uchar int vertex_indices\n"));
  if (!of_labels_) file_.append(text(kOnFaces, colours));
  file_.append(std::string_view("end_header\n"));
}

void PlySink::append_comments() {
  for (const std::string& comment :
       {std::string("mwmesh"), shift_comment(header_), space_comment(header_)}) {
    if (!comment.empty()) file_.append("comment " + comment + "\n");
  }
  const LabelTable& table = header_.labels->table;
  for (const Label rank : ranks_of(header_)) {
    const RawLabel raw = table.raw(rank);
    if (const LabelName* row = header_.labels->names.find(raw)) {
      // The '#' of Medit's format is left out.
      file_.append("comment" + medit_comment(*row, table.is_signed()).substr(1));
    }
    const std::int64_t number = (*numbers_)[rank];
    if (static_cast<RawLabel>(number) != raw) {
      file_.append(
          text("comment number ", number, " is label ", label_text(raw, table.is_signed()), "\n"));
    }
  }
}

void PlySink::append_number(Label rank) {
  append_little(file_, static_cast<std::int32_t>((*numbers_)[rank]));
}

void PlySink::append_colour(Label rank) {
  if (!colours_) return;
  const Colour colour = header_.labels->colour(rank);
  for (std::size_t i = 0; i < 3; ++i) append_little(file_, colour[i]);
}

void PlySink::write_vertices(std::span<const Position> positions) {
  for (const Position& position : positions) {
    for (const double x : position) append_little(file_, x);
    if (!of_labels_) continue;
    while (shell_vertex_ == header_.shells[shell_].vertices) {
      ++shell_;
      shell_vertex_ = 0;
    }
    ++shell_vertex_;
    append_number(*header_.shells[shell_].label);
    append_colour(*header_.shells[shell_].label);
  }
}

void PlySink::write_triangles(std::span<const Triangle> triangles) {
  for (const Triangle& triangle : triangles) {
    append_little(file_, std::uint8_t{3});
    for (const std::uint64_t vertex : triangle) {
      append_little(file_, static_cast<std::int32_t>(vertex));
    }
    if (of_labels_) continue;
    cursor_->next();
    const SurfaceRun& run = cursor_->run();
    append_number(run.inside);
    if (run.side == Side::kInterface) {
      append_number(run.outside);
    } else {
      append_little(file_, std::int32_t{0});
    }
    append_little(file_, static_cast<std::uint8_t>(run.side));
    append_colour(run.inside);
  }
}

struct SurfaceFormat {
  const char* extension;
  std::unique_ptr<SurfaceSink> (*open)(const std::filesystem::path&);
};

template <class Sink>
std::unique_ptr<SurfaceSink> open(const std::filesystem::path& path) {
  return std::make_unique<Sink>(path);
}

constexpr std::array kFormats{
    SurfaceFormat{".stl", &open<StlSink>},
    SurfaceFormat{".ply", &open<PlySink>},
};

const SurfaceFormat* find_format(const std::filesystem::path& path) {
  for (const SurfaceFormat& format : kFormats) {
    if (path.extension() == format.extension) return &format;
  }
  return nullptr;
}

}  // namespace

std::string surface_extensions() {
  std::string out;
  for (const SurfaceFormat& format : kFormats) {
    out += (out.empty() ? "" : ", ") + text(format.extension);
  }
  return out;
}

bool is_surface_path(const std::filesystem::path& path) {
  return find_format(path) != nullptr;
}

std::unique_ptr<SurfaceSink> open_surface_sink(const std::filesystem::path& path) {
  if (const SurfaceFormat* format = find_format(path)) return format->open(path);
  fail_usage(path.string(), ": extension '", path.extension().string(),
             "' is no surface format known here; supported are ", surface_extensions());
}

}  // namespace mw::io
