// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads a tetrahedral .vtkhdf file.
#include "io/mesh/vtkhdf/vtkhdf_reader.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "io/file/errors.h"
#include "io/file/file_source.h"
#include "io/mesh/apart_mesh.h"
#include "io/mesh/label_names.h"
#include "io/mesh/vtkhdf/hdf5_array.h"
#include "io/mesh/vtkhdf/vtkhdf_names.h"

namespace mw::io {
namespace {

constexpr std::uint64_t kVtkTetra = 10;
constexpr std::uint64_t kBatchRows = kMostApartRows;
/// Of a file that a slow processor unpacks and checks.
constexpr std::uint64_t kBytesPerSecond = 1 << 20;

Hdf5Handle open_grid(const std::string& file) {
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

std::string type_of(hid_t group) {
  const Hdf5Handle attribute(H5Aopen(group, "Type", H5P_DEFAULT), &H5Aclose);
  const Hdf5Handle type(H5Aget_type(attribute.get()), &H5Tclose);
  if (!type.valid() || H5Tget_class(type.get()) != H5T_STRING) return {};
  if (H5Tis_variable_str(type.get()) != 0) return {};
  std::string value(H5Tget_size(type.get()), '\0');
  if (H5Aread(attribute.get(), type.get(), value.data()) < 0) return {};
  return value.substr(0, value.find('\0'));
}

class Reader {
 public:
  /// facts: names and record.
  Reader(const Hdf5Handle& group, MeshHeader facts, const std::string& file, MeshSink& sink)
      : file_(file),
        sink_(sink),
        points_(group.get(), "Points", file),
        connectivity_(group.get(), "Connectivity", file),
        offsets_(group.get(), "Offsets", file),
        types_(group.get(), "Types", file),
        point_counts_(counts(group.get(), "NumberOfPoints")),
        cell_counts_(counts(group.get(), "NumberOfCells")),
        labels_(label_array(group.get())),
        header_(std::move(facts)) {}

  void read() {
    check_arrays();
    const std::uint64_t tets = sum(cell_counts_);
    header_.tets = tets;
    header_.labels_signed = labels_ && labels_->is_signed();
    sink_.begin(header_);
    for (std::size_t part = 0; part < cell_counts_.size(); ++part) {
      read_points(point_counts_[part]);
      check_types(cell_counts_[part]);
      check_offsets(part, cell_counts_[part]);
      read_cells(point_counts_[part], cell_counts_[part]);
    }
    sink_.finish();
  }

 private:
  [[nodiscard]] std::vector<std::uint64_t> counts(hid_t group, const char* name) const {
    const Hdf5Array array(group, name, file_);
    std::vector<std::uint64_t> out(array.rows());
    if (!array.is_integer() || array.components() != 1) array.fail("holds no counts");
    array.read(0, out.size(), out.data());
    return out;
  }

  /// The sum; counts that the arrays cannot have are refused where those are read.
  [[nodiscard]] std::uint64_t sum(const std::vector<std::uint64_t>& counts) const {
    std::uint64_t all = 0;
    for (const std::uint64_t count : counts) {
      if (count > types_.rows() + points_.rows()) {
        fail_input(file_, "counts", text(count, " is not credible"), "the file is damaged");
      }
      all += count;
    }
    return all;
  }

  [[nodiscard]] std::optional<Hdf5Array> label_array(hid_t group) const {
    if (std::all_of(cell_counts_.begin(), cell_counts_.end(), [](auto n) { return n == 0; })) {
      return std::nullopt;
    }
    std::vector<std::string> integers;
    for (const std::string& name : cell_arrays(group)) {
      const Hdf5Array array(group, "CellData/" + name, file_);
      if (array.is_integer() && array.components() == 1) integers.push_back(name);
    }
    const std::string* name = choose_label(integers);
    if (name == nullptr) {
      fail_input(file_, "cell data",
                 text("none of ", integers.size(), " integer arrays is called 'label'"),
                 "store the labels as an integer cell array 'label'");
    }
    return Hdf5Array(group, "CellData/" + *name, file_);
  }

  [[nodiscard]] static std::vector<std::string> cell_arrays(hid_t group) {
    std::vector<std::string> names;
    const Hdf5Handle cell_data(H5Gopen2(group, "CellData", H5P_DEFAULT), &H5Gclose);
    H5G_info_t info{};
    if (!cell_data.valid() || H5Gget_info(cell_data.get(), &info) < 0) return names;
    for (hsize_t i = 0; i < info.nlinks; ++i) {
      const auto name = [&](char* out, std::size_t size) {
        return H5Lget_name_by_idx(cell_data.get(), ".", H5_INDEX_NAME, H5_ITER_INC, i, out, size,
                                  H5P_DEFAULT);
      };
      std::string found(static_cast<std::size_t>(std::max<ssize_t>(name(nullptr, 0), 0)), '\0');
      name(found.data(), found.size() + 1);
      names.push_back(found);
    }
    return names;
  }

  void check_arrays() const {
    if (points_.components() != 3) points_.fail("not of 3 components");
    for (const Hdf5Array* array : {&connectivity_, &offsets_, &types_}) {
      if (!array->is_integer() || array->components() != 1) array->fail("holds no integers");
    }
    if (point_counts_.size() != cell_counts_.size()) points_.fail("partitions do not agree");
  }

  void read_points(std::uint64_t count) {
    std::vector<Position> batch;
    for (const std::uint64_t end = next_point_ + count; next_point_ < end;) {
      batch.resize(std::min(kBatchRows, end - next_point_));
      points_.read(next_point_, batch.size(), batch.data()->data());
      for (const Position& p : batch) {
        if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) {
          points_.fail(text("a point behind row ", next_point_, " is not finite"));
        }
      }
      sink_.write_vertices(batch);
      next_point_ += batch.size();
    }
  }

  void check_types(std::uint64_t count) const {
    std::vector<std::uint64_t> batch;
    for (std::uint64_t at = 0; at < count; at += batch.size()) {
      batch.resize(std::min(kBatchRows, count - at));
      types_.read(next_cell_ + at, batch.size(), batch.data());
      for (const std::uint64_t type : batch) {
        if (type == kVtkTetra) continue;
        fail_input(file_, text("a cell behind row ", next_cell_ + at),
                   text("type ", type, " is no tetrahedron (10)"), "keep only the tetrahedra");
      }
    }
  }

  /// Each partition has an offset more than cells; four numbers a cell.
  void check_offsets(std::size_t part, std::uint64_t count) const {
    std::vector<std::uint64_t> batch;
    for (std::uint64_t at = 0; at <= count; at += batch.size()) {
      batch.resize(std::min(kBatchRows, count + 1 - at));
      offsets_.read(next_cell_ + part + at, batch.size(), batch.data());
      for (std::size_t i = 0; i < batch.size(); ++i) {
        if (batch[i] != 4 * (at + i)) offsets_.fail(text(batch[i], " is not ", 4 * (at + i)));
      }
    }
  }

  void read_cells(std::uint64_t points, std::uint64_t count) {
    const std::uint64_t first_point = next_point_ - points;
    std::vector<std::int64_t> corners;
    std::vector<TetRows> tets;
    std::vector<RawLabel> labels;
    for (const std::uint64_t end = next_cell_ + count; next_cell_ < end;) {
      tets.resize(std::min(kBatchRows, end - next_cell_));
      corners.resize(4 * tets.size());
      connectivity_.read(4 * next_cell_, corners.size(), corners.data());
      for (std::size_t i = 0; i < corners.size(); ++i) {
        if (corners[i] < 0 || static_cast<std::uint64_t>(corners[i]) >= points) {
          connectivity_.fail(text("names point ", corners[i], ", there are ", points));
        }
        tets[i / 4][i % 4] = first_point + static_cast<std::uint64_t>(corners[i]);
      }
      labels.resize(tets.size());
      read_labels(labels);
      sink_.write_tets(tets, labels);
      next_cell_ += tets.size();
    }
  }

  void read_labels(std::vector<RawLabel>& out) const {
    if (!labels_->is_signed()) return labels_->read(next_cell_, out.size(), out.data());
    std::vector<std::int64_t> labels(out.size());
    labels_->read(next_cell_, labels.size(), labels.data());
    std::transform(labels.begin(), labels.end(), out.begin(),
                   [](std::int64_t label) { return static_cast<RawLabel>(label); });
  }

  std::string file_;
  MeshSink& sink_;
  Hdf5Array points_;
  Hdf5Array connectivity_;
  Hdf5Array offsets_;
  Hdf5Array types_;
  std::vector<std::uint64_t> point_counts_;  ///< by partition
  std::vector<std::uint64_t> cell_counts_;
  std::optional<Hdf5Array> labels_;  ///< unless there are no cells
  MeshHeader header_;
  std::uint64_t next_point_ = 0;
  std::uint64_t next_cell_ = 0;
};

/// In a child: damage makes the library crash.
void read_here(const std::string& path, MeshSink& sink) {
  const Hdf5Handle file = open_grid(path);
  const Hdf5Handle group(H5Gopen2(file.get(), "VTKHDF", H5P_DEFAULT), &H5Gclose);
  if (!group.valid()) fail_input(path, "group VTKHDF", "missing", "give a VTKHDF file");
  const std::string type = type_of(group.get());
  if (type != "UnstructuredGrid") {
    fail_input(path, "attribute Type", text("'", type, "' is not UnstructuredGrid"),
               "give a VTKHDF file of tetrahedra");
  }
  MeshHeader facts;
  facts.names = read_vtkhdf_names(file.get(), group.get(), path);
  facts.record = read_vtkhdf_record(file.get(), path);
  Reader(group, std::move(facts), path, sink).read();
}

}  // namespace

void read_vtkhdf(const std::filesystem::path& path, MeshSink& sink) {
  const FileSource exists(path);
  ApartLimits limits;
  limits.cpu_seconds += exists.size() / kBytesPerSecond;
  const std::string death = pass_mesh_apart(
      limits, [&](MeshSink& out) { read_here(exists.name(), out); }, sink);
  if (death.empty()) return sink.finish();
  fail_input(exists.name(), "HDF5 structure", text("the HDF5 library could not read it: ", death),
             "the file is damaged: write the mesh anew, or check it with h5dump");
}

}  // namespace mw::io
