// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads data sets of numbers in an HDF5 file by rows, and meshes that are made of them.
#include "io/mesh/vtkhdf/hdf5_array.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/file/errors.h"
#include "io/mesh/apart_mesh.h"
#include "io/volume/hdf5/describe_apart.h"
#include "io/volume/hdf5/open_hdf5.h"

namespace mw::io {
namespace {

/// No filter of HDF5's own packs tighter than this.
constexpr std::uint64_t kMaxPacking = 1040;
/// Keeps products of counts and sizes within 64 bits.
constexpr std::uint64_t kMaxRows = std::uint64_t{1} << 56;

/// How many bytes of a file a slow processor unpacks and checks in a second.
constexpr std::uint64_t kBytesPerSecond = 1 << 20;

/// Returns a chunk as the file has it, and which filters it lacks; nothing where there is none.
std::optional<std::vector<std::byte>> packed_chunk(hid_t set, std::span<const hsize_t, 2> at,
                                                   std::uint32_t& skipped) {
  hsize_t bytes = 0;
  const herr_t found = H5Dget_chunk_storage_size(set, at.data(), &bytes);
  if (found < 0 || bytes == 0 || bytes > kMaxHdf5ChunkBytes) return std::nullopt;
  std::vector<std::byte> out(bytes);
  if (H5Dread_chunk(set, H5P_DEFAULT, at.data(), &skipped, out.data()) < 0) return std::nullopt;
  return out;
}

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

Hdf5Array::Hdf5Array(hid_t where, const std::string& path, const std::string& file)
    : file_(file), path_(path), set_(H5Dopen2(where, path.c_str(), H5P_DEFAULT), &H5Dclose) {
  check_place(where);
  inspect();
}

void Hdf5Array::check_place(hid_t where) const {
  H5L_info_t link{};
  const bool leads_away = !set_.valid() &&
                          H5Lget_info(where, path_.c_str(), &link, H5P_DEFAULT) >= 0 &&
                          link.type == H5L_TYPE_EXTERNAL;
  if (!set_.valid() && !leads_away) fail("missing or damaged");
  const std::optional<Hdf5Elsewhere> found =
      leads_away ? Hdf5Elsewhere{"a link leads to another file", "h5copy what it leads to"}
                 : stored_elsewhere(where, set_.get());
  if (found) fail_input(file_, text("data set '", path_, "'"), found->reason, found->way_out);
}

void Hdf5Array::inspect() {
  const Hdf5Handle type(H5Dget_type(set_.get()), &H5Tclose);
  const H5T_class_t kind = H5Tget_class(type.get());
  if (kind != H5T_INTEGER && kind != H5T_FLOAT) fail("holds no numbers");
  is_integer_ = kind == H5T_INTEGER;
  is_signed_ = is_integer_ && H5Tget_sign(type.get()) == H5T_SGN_2;
  const Hdf5Handle space(H5Dget_space(set_.get()), &H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank != 1 && rank != 2) fail(text("has ", rank, " dimensions"));
  std::array<hsize_t, 2> size{0, 1};
  H5Sget_simple_extent_dims(space.get(), size.data(), nullptr);
  rows_ = size[0];
  components_ = size[1];
  if (rows_ >= kMaxRows || components_ > 16) fail("its size is not credible");
  check_storage(H5Tget_size(type.get()));
  check_packed_chunks(H5Tget_size(type.get()));
}

void Hdf5Array::check_storage(std::size_t number_bytes) const {
  const std::uint64_t bytes = rows_ * components_ * number_bytes;
  if (bytes / kMaxPacking > H5Dget_storage_size(set_.get())) {
    fail(text("announces ", rows_, " rows, its bytes in the file cannot hold them"));
  }
}

/// H5Dread() does not look how much a chunk unpacks to: of a short one it gives what was in memory.
/// A chunk that the library does not find is one for H5Dread().
void Hdf5Array::check_packed_chunks(std::size_t number_bytes) const {
  const Hdf5Handle list(H5Dget_create_plist(set_.get()), &H5Pclose);
  if (H5Pget_layout(list.get()) != H5D_CHUNKED) return;
  const auto filters = hdf5_filters(list.get());
  if (!filters) fail("its filters are unknown");
  if (filters->empty()) return;
  Hdf5Description packed;
  packed.path = path_;
  packed.filters = *filters;
  check_filters(packed, file_);
  std::array<hsize_t, 2> shape{1, 1}, at{0, 0};
  if (H5Pget_chunk(list.get(), 2, shape.data()) < 1 || shape[0] == 0 || shape[1] == 0 ||
      shape[0] > kMaxHdf5ChunkBytes || shape[1] > kMaxHdf5ChunkBytes) {
    fail("its chunks are not credible");
  }
  unsigned options = 0;
  H5Pget_chunk_opts(list.get(), &options);
  const bool leaves_edges = (options & H5D_CHUNK_DONT_FILTER_PARTIAL_CHUNKS) != 0;
  const std::string name = text(file_, ": data set '", path_, "'");
  for (; at[0] < rows_; at[0] += shape[0]) {
    for (at[1] = 0; at[1] < components_; at[1] += shape[1]) {
      Unfiltering wanted{.bytes = shape[0] * shape[1] * number_bytes, .name = name};
      auto chunk = packed_chunk(set_.get(), at, wanted.skipped);
      const bool is_edge = at[0] + shape[0] > rows_ || at[1] + shape[1] > components_;
      if (chunk && leaves_edges && is_edge) wanted.skipped = UINT32_MAX;
      if (chunk) static_cast<void>(unfilter(*filters, std::move(*chunk), wanted));
    }
  }
}

void Hdf5Array::read(std::uint64_t first, std::uint64_t count, double* out) const {
  read_as(first, count, H5T_NATIVE_DOUBLE, out);
}
void Hdf5Array::read(std::uint64_t first, std::uint64_t count, std::int64_t* out) const {
  read_as(first, count, H5T_NATIVE_INT64, out);
}
void Hdf5Array::read(std::uint64_t first, std::uint64_t count, std::uint64_t* out) const {
  read_as(first, count, H5T_NATIVE_UINT64, out);
}

void Hdf5Array::read_as(std::uint64_t first, std::uint64_t count, hid_t type, void* out) const {
  if (first > rows_ || count > rows_ - first) {
    fail(text("holds ", rows_, " rows, ", first + count, " are needed"));
  }
  if (count == 0) return;
  const std::array<hsize_t, 2> start{first, 0};
  const std::array<hsize_t, 2> size{count, components_};
  const Hdf5Handle where(H5Dget_space(set_.get()), &H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(where.get());
  const Hdf5Handle memory(H5Screate_simple(rank, size.data(), nullptr), &H5Sclose);
  if (H5Sselect_hyperslab(where.get(), H5S_SELECT_SET, start.data(), nullptr, size.data(),
                          nullptr) < 0 ||
      H5Dread(set_.get(), type, memory.get(), where.get(), H5P_DEFAULT, out) < 0) {
    fail(text("cannot read rows ", first, " to ", first + count));
  }
}

void Hdf5Array::fail(const std::string& reason) const {
  fail_input(file_, text("data set '", path_, "'"), reason, "the file is truncated or damaged");
}

Hdf5Handle open_hdf5(const std::string& file) {
  silence_hdf5();
  // Otherwise a file could make the library load code, or read files that it names.
  H5PLset_loading_state(0);
  H5Lunregister(H5L_TYPE_EXTERNAL);
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
  const std::uint64_t rows = out.size() / labels.components();
  if (!labels.is_signed()) return labels.read(first, rows, out.data());
  std::vector<std::int64_t> numbers(out.size());
  labels.read(first, rows, numbers.data());
  std::transform(numbers.begin(), numbers.end(), out.begin(),
                 [](std::int64_t label) { return static_cast<RawLabel>(label); });
}

}  // namespace mw::io
