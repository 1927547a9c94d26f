// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What readers of meshes in HDF5 files share.
#include "io/mesh/vtkhdf/hdf5_mesh.h"

#include <algorithm>
#include <cmath>

#include "io/file/errors.h"
#include "io/mesh/apart_mesh.h"

namespace mw::io {
namespace {

/// Of a file that a slow processor unpacks and checks.
constexpr std::uint64_t kBytesPerSecond = 1 << 20;

void check_finite(const Hdf5Array& points, std::uint64_t first,
                  const std::vector<Position>& batch) {
  for (const Position& p : batch) {
    if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2])) continue;
    points.fail(text("a point behind row ", first, " is not finite"));
  }
}

void keep_rows(const KeptRows& kept, std::uint64_t first, std::vector<Position>& batch) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < batch.size(); ++i) {
    if (kept.stays(first + i)) batch[count++] = batch[i];
  }
  batch.resize(count);
}

}  // namespace

Hdf5Handle open_hdf5(const std::string& file) {
  silence_hdf5();
  // A file on a read-only or shared disk cannot always be locked, and nobody writes in place.
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose);
  H5Pset_file_locking(access.get(), false, true);
  Hdf5Handle hdf5(H5Fopen(file.c_str(), H5F_ACC_RDONLY, access.get()), &H5Fclose);
  if (!hdf5.valid()) {
    fail_input(file, {}, "no HDF5 file, or truncated or damaged", "write the mesh anew");
  }
  return hdf5;
}

void read_hdf5_apart(const std::string& file, std::uint64_t bytes,
                     const std::function<void(MeshSink&)>& read, MeshSink& sink) {
  ApartLimits limits;
  limits.cpu_seconds += bytes / kBytesPerSecond;
  const std::string death = pass_mesh_apart(limits, read, sink);
  if (death.empty()) return sink.finish();
  fail_input(file, "HDF5 structure", text("the HDF5 library could not read it: ", death),
             "the file is damaged: write the mesh anew, or check it with h5dump");
}

void stream_points(const Hdf5Array& points, RowRange range, const KeptRows* kept, MeshSink& sink) {
  std::vector<Position> batch;
  for (std::uint64_t at = range.begin; at < range.end;) {
    batch.resize(std::min(kMaxApartRows, range.end - at));
    points.read(at, batch.size(), batch.data()->data());
    check_finite(points, at, batch);
    const std::uint64_t first = at;
    at += batch.size();
    if (kept != nullptr) keep_rows(*kept, first, batch);
    sink.write_vertices(batch);
  }
}

void read_labels(const Hdf5Array& labels, std::uint64_t first, std::vector<RawLabel>& out) {
  if (!labels.is_signed()) return labels.read(first, out.size(), out.data());
  std::vector<std::int64_t> numbers(out.size());
  labels.read(first, numbers.size(), numbers.data());
  std::transform(numbers.begin(), numbers.end(), out.begin(),
                 [](std::int64_t label) { return static_cast<RawLabel>(label); });
}

}  // namespace mw::io
