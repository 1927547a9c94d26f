// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Spaces, boxes, names and meshes of the library as io has them.
#include "engine/api/types.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/api/guarded.h"
#include "engine/settings/size_text.h"
#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/mesh/field_names.h"
#include "io/mesh/open_mesh.h"
#include "io/volume/checks.h"
#include "io/volume/open_volume.h"

namespace mw::api {
namespace {

io::WorldFrame frame_of(const std::string& name, const char* expected = "own, ras or lps") {
  for (const io::WorldFrame frame :
       {io::WorldFrame::kOwn, io::WorldFrame::kRas, io::WorldFrame::kLps}) {
    if (name == io::name(frame)) return frame;
  }
  io::fail_usage("frame ", name, ": expected ", expected);
}

void check_axes(const std::array<mwmesh::Vector, 3>& axes) {
  constexpr double kMost = 1e-4;  // what io::placed() straightens
  for (std::size_t i = 0; i < 3; ++i) {
    const mwmesh::Vector &a = axes[i], &b = axes[(i + 1) % 3];
    const bool is_unit = std::abs(std::hypot(a[0], a[1], a[2]) - 1) < kMost;
    if (!is_unit) io::fail_usage("axes must have unit length");
    if (std::abs(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) <= kMost) continue;
    io::fail_usage(
        "axes must be at right angles: resample a sheared volume onto a grid that has "
        "them, or leave the axes out");
  }
}

/// True if axes differ by no more than rounding.  To straighten axes that are straight already, as
/// those of a file are, would change last bits, so that an array had another mesh than its file.
bool are_alike(const std::array<io::Vector3, 3>& one, const std::array<mwmesh::Vector, 3>& other) {
  constexpr double kRounding = 1e-15;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (std::abs(one[i][k] - other[i][k]) > kRounding) return false;
    }
  }
  return true;
}

/// Throws if a column of an affine, or what it adds, is no place in the world.
void check_affine(const std::array<std::array<double, 4>, 3>& affine) {
  for (std::size_t k = 0; k < 4; ++k) {
    const double length = std::hypot(affine[0][k], affine[1][k], affine[2][k]);
    if (std::isfinite(length) && (length > 0 || k == 3)) continue;
    throw Error(ErrorKind::kInput,
                io::text("affine: column ", k + 1, " must be finite",
                         k == 3 ? "" : " and not 0, as it is the edge of a voxel"));
  }
}

/// Returns whether the numbers are those of a header in floats of 32 bits, as most are in NIfTI.
bool is_in_floats(const std::array<std::array<double, 4>, 3>& affine) {
  const auto is_float = [](double x) {
    return std::abs(x) <= std::numeric_limits<float>::max() &&
           static_cast<double>(static_cast<float>(x)) == x;
  };
  return std::all_of(affine.begin(), affine.end(), [&](const auto& row) {
    return std::all_of(row.begin(), row.end(), is_float);
  });
}

/// Writes points, tets and values in batches, between which a sink may ask whether to go on.
void write_rows(const mwmesh::Mesh& mesh, bool values, io::MeshSink& sink) {
  constexpr std::size_t kBatch = 1 << 16;  // a multiple of the parts of a curved tet
  const std::span points(mesh.points);
  for (std::size_t at = 0; at < points.size(); at += kBatch) {
    sink.write_vertices(points.subspan(at, std::min(kBatch, points.size() - at)));
  }
  const std::span tets(mesh.tets);
  const std::span labels(mesh.labels);
  std::vector<double> rows;
  for (std::size_t at = 0; at < tets.size(); at += kBatch) {
    const std::size_t count = std::min(kBatch, tets.size() - at);
    sink.write_tets(tets.subspan(at, count), labels.subspan(at, count));
    if (!values) continue;
    rows.clear();
    for (std::size_t t = at; t < at + count; ++t) {
      for (const auto& [name, column] : mesh.values) rows.push_back(column[t]);
    }
    sink.write_values(rows);
  }
}

}  // namespace

io::VolumeSpace io_space(const mwmesh::Space& space) {
  io::check_place(space.spacing, space.origin);
  check_axes(space.axes);
  io::FileSpace told{.lengths = space.spacing,
                     .first = space.origin,
                     .first_is_centre = false,
                     .unit = space.unit,
                     .frame = frame_of(space.frame)};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) told.steps[i][k] = space.axes[i][k] * space.spacing[i];
  }
  io::VolumeSpace out = io::placed(kArray, told, {});
  if (are_alike(out.axes, space.axes)) out.axes = space.axes;
  return out;
}

mwmesh::Space library_space(const io::VolumeSpace& space) {
  return {.spacing = space.spacing,
          .origin = space.origin,
          .axes = space.axes,
          .unit = space.unit,
          .frame = io::name(space.frame)};
}

Box3 io_box(const mwmesh::Box& box) {
  return {{box.lo[0], box.lo[1], box.lo[2]}, {box.hi[0], box.hi[1], box.hi[2]}};
}

mwmesh::Box library_box(const Box3& box) {
  return {{box.lo.x, box.lo.y, box.lo.z}, {box.hi.x, box.hi.y, box.hi.z}};
}

io::LabelNames io_names(const std::vector<mwmesh::LabelName>& names) {
  std::vector<io::LabelName> rows;
  rows.reserve(names.size());
  for (const mwmesh::LabelName& n : names) {
    rows.push_back({.label = n.label, .name = n.name, .colour = n.colour});
  }
  return io::LabelNames(std::move(rows));
}

std::vector<mwmesh::LabelName> library_names(const io::LabelNames& names) {
  std::vector<mwmesh::LabelName> out;
  for (const io::LabelName& row : names.rows()) {
    out.push_back({.label = row.label, .name = row.name, .colour = row.colour});
  }
  return out;
}

mwmesh::Mesh library_mesh(io::MeshData&& mesh) {
  std::map<std::string, std::vector<double>> values;
  for (io::TetValues& column : mesh.values) values[column.name] = std::move(column.numbers);
  return {.points = std::move(mesh.vertices),
          .tets = std::move(mesh.tets),
          .labels = std::move(mesh.labels),
          .labels_are_signed = mesh.labels_signed,
          .names = library_names(mesh.names),
          .values = std::move(values),
          .report = {},
          .record = io::record_text(mesh.record),
          .in_parts = mesh.in_parts};
}

std::unique_ptr<io::MeshSink> open_file(const std::filesystem::path& path,
                                        const mwmesh::FileOptions& file, bool has_values,
                                        bool has_wedges) {
  io::MeshExtras extras{.deck = file.deck, .wedges = has_wedges, .pairs = file.pairs};
  if (!file.materials.empty()) {
    extras.materials = naming("materials", [&] { return engine::parse_materials(file.materials); });
  } else if (has_values) {
    io::require_place_for_values(path);
  }
  auto sink = io::open_mesh_sink(checked_path(path), io::parse_element(file.element), extras);
  if (extras.materials && !file.values && io::why_no_values(path).empty()) {
    io::fail_usage("values: " + path.string() +
                   " has values of tets where it has materials; write "
                   "them, too, or give an .inp, which has materials alone");
  }
  return sink;
}

void deliver(const mwmesh::Mesh& mesh, io::MeshSink& sink, bool values) {
  if (mesh.labels.size() != mesh.tets.size()) {
    io::fail_usage("mesh: there must be one label a tet");
  }
  for (const auto& [name, column] : mesh.values) {
    if (column.size() == mesh.tets.size()) continue;
    io::fail_usage("mesh: there must be one value '" + name + "' a tet");
  }
  for (const auto& tet : mesh.tets) {
    for (const std::uint64_t row : tet) {
      if (row < mesh.points.size()) continue;
      io::fail_usage("mesh: a tet names point " + std::to_string(row) + " of " +
                     std::to_string(mesh.points.size()));
    }
  }
  if (mesh.in_parts && mesh.tets.size() % kTetParts.size() != 0) {
    io::fail_usage("mesh: in_parts needs eight tets for each curved one, and there are ",
                   mesh.tets.size());
  }
  io::MeshHeader header{.tets = mesh.tets.size(),
                        .labels_signed = mesh.labels_are_signed,
                        .names = io_names(mesh.names),
                        .record = io::parse_record(mesh.record, "mesh")};
  header.in_parts = mesh.in_parts;
  if (values) {
    for (const auto& [name, column] : mesh.values) header.values.push_back(name);
    header.values = io::value_names(header.values);
  }
  sink.begin(header);
  write_rows(mesh, !header.values.empty(), sink);
  sink.finish();
}

}  // namespace mw::api

namespace mwmesh {

Space space_of_affine(const std::array<std::array<double, 4>, 3>& affine, const std::string& frame,
                      const std::optional<Vector>& spacing) {
  return mw::api::guarded([&] {
    mw::api::check_affine(affine);
    const bool is_voxel = frame == "voxel";
    mw::io::FileSpace told{.first = mw::io::Vector3{},
                           .frame = is_voxel ? mw::io::WorldFrame::kOwn
                                             : mw::api::frame_of(frame, "own, ras, lps or voxel"),
                           .steps_field = "affine",
                           .first_field = "affine"};
    told.in_floats = mw::api::is_in_floats(affine);
    const auto number = [&](double x) {
      return told.in_floats ? mw::io::decimal_of(static_cast<float>(x)) : x;
    };
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < 3; ++i) told.steps[i][k] = number(affine[k][i]);
      (*told.first)[k] = number(affine[k][3]);
    }
    if (spacing) {
      for (const double edge : *spacing) mw::io::check_spacing("affine", "spacing", edge);
      told.lengths = *spacing;
    }
    mw::io::OpenOptions options;
    if (is_voxel) options.frame = mw::io::FrameChoice::kVoxel;
    return mw::api::library_space(mw::io::placed(mw::api::kArray, told, options));
  });
}

}  // namespace mwmesh
