// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads a tetrahedral .vtkhdf file.
#include "io/mesh/vtkhdf/vtkhdf.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "io/file/errors.h"
#include "io/file/source/file_source.h"
#include "io/mesh/apart_mesh.h"
#include "io/mesh/element.h"
#include "io/mesh/field_names.h"
#include "io/mesh/kept_rows.h"
#include "io/mesh/vtkhdf/hdf5_array.h"

namespace mw::io {
namespace {

/// The number of cells read at a time, each of which may become several tets.
constexpr std::uint64_t kBatchRows = kMaxApartRows / kTetParts.size();

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
  /// facts holds the names and the record.
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
        header_(std::move(facts)) {
    header_.in_parts = header_.record.curved;
    header_.record.curved = false;
    find_values(group.get());
  }

  void read() {
    check_arrays();
    const std::uint64_t cells = sum(cell_counts_);
    for (std::size_t part = 0; part < cell_counts_.size(); ++part) survey(part);
    if (labels_) check_rows(*labels_, cells);
    for (const Hdf5Array& array : values_) check_rows(array, cells);
    header_.tets = (cells - wedges_) * parts();
    header_.labels_signed = labels_ && labels_->is_signed();
    header_.ten_nodes = drops_middles();
    sink_.begin(header_);
    if (drops_middles()) find_middles();
    for (std::size_t part = 0; part < cell_counts_.size(); ++part) {
      read_points(part);
      read_cells(part);
    }
    sink_.finish();
  }

 private:
  using Numbers = std::vector<std::uint64_t>;

  /// Returns how many tets of the mesh a tet of the file becomes.
  [[nodiscard]] std::size_t parts() const { return header_.in_parts ? kTetParts.size() : 1; }
  [[nodiscard]] bool drops_middles() const { return ten_nodes_ && !header_.in_parts; }

  [[nodiscard]] std::vector<std::uint64_t> counts(hid_t group, const char* name) const {
    const Hdf5Array array(group, name, file_);
    std::vector<std::uint64_t> out(array.rows());
    if (!array.is_integer() || array.components() != 1) array.fail("holds no counts");
    array.read(0, out.size(), out.data());
    return out;
  }

  /// Returns the sum.  Counts beyond all rows are refused here, others where rows are read.
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

  /// Finds the values, which are cell arrays of floats with one component.
  void find_values(hid_t group) {
    if (!labels_) return;
    std::vector<std::string> names;
    for (const std::string& name : cell_arrays(group)) {
      Hdf5Array array(group, "CellData/" + name, file_);
      if (array.is_integer() || array.components() != 1 || names.size() == kMostValues) continue;
      names.push_back(name);
      values_.push_back(std::move(array));
    }
    header_.values = value_names(names);
  }

  void check_rows(const Hdf5Array& array, std::uint64_t cells) const {
    if (array.rows() == cells) return;
    array.fail(text("has ", array.rows(), " rows, there are ", cells, " cells"));
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

  /// Where the rows of a partition begin.
  struct Part {
    std::uint64_t points = 0;
    std::uint64_t cells = 0;
    std::uint64_t nodes = 0;  ///< rows of the connectivity
  };

  /// Checks the types and offsets of a partition, which has one offset more than cells.
  void survey(std::size_t part) {
    const std::uint64_t count = cell_counts_[part];
    std::vector<std::uint64_t> types, ends;
    std::uint64_t end = 0;
    check_first_offset(part);
    for (std::uint64_t at = 0; at < count; at += types.size()) {
      types.resize(std::min(kBatchRows, count - at));
      ends.resize(types.size());
      types_.read(next_.cells + at, types.size(), types.data());
      offsets_.read(next_.cells + part + at + 1, ends.size(), ends.data());
      for (std::size_t i = 0; i < types.size(); ++i) {
        end += nodes_of(types[i], next_.cells + at);
        wedges_ += is_vtk_wedge(types[i]) ? 1U : 0U;
        if (ends[i] != end) offsets_.fail(text(ends[i], " is not ", end));
      }
    }
    parts_.push_back(next_);
    next_.points += point_counts_[part];
    next_.cells += count;
    next_.nodes += end;
    if (next_.points > points_.rows()) {
      points_.fail(text("holds ", points_.rows(), " rows, ", next_.points, " are needed"));
    }
  }

  void check_first_offset(std::size_t part) const {
    std::uint64_t begin = 0;
    offsets_.read(next_.cells + part, 1, &begin);
    if (begin != 0) offsets_.fail(text(begin, " is not 0"));
  }

  [[nodiscard]] std::uint64_t nodes_of(std::uint64_t type, std::uint64_t row) {
    const std::uint64_t nodes = vtk_nodes_of(type, header_.record.cohesive.any());
    if (nodes == 0) {
      fail_input(file_, text("a cell behind row ", row),
                 text("type ", type, " is no tetrahedron (10 or 24)"), "keep only the tetrahedra");
    }
    if (header_.in_parts && type == kVtkTetra) {
      fail_input(file_, text("a cell behind row ", row),
                 "the curved mesh has a tet without ten nodes");
    }
    ten_nodes_ = ten_nodes_ || type == kVtkQuadraticTetra;
    return nodes;
  }

  /// Calls take(tets, middles, types) on batches of a partition's cells; middles are those of tets.
  /// Curved tets come in their parts, without middles.  Wedges are left out, because the record
  /// tells of them and they follow from the tets.
  template <class Take>
  void each_batch(std::size_t part, Take take) {
    std::vector<std::uint64_t> types, middles;
    std::vector<std::int64_t> nodes;
    std::vector<TetRows> tets;
    std::uint64_t node = parts_[part].nodes;
    for (std::uint64_t at = 0; at < cell_counts_[part]; at += types.size()) {
      types.resize(std::min(kBatchRows, cell_counts_[part] - at));
      types_.read(parts_[part].cells + at, types.size(), types.data());
      std::uint64_t count = 0;
      for (const std::uint64_t type : types) count += nodes_of(type, at);
      nodes.resize(count);
      connectivity_.read(node, count, nodes.data());
      node += count;
      tets.clear();
      middles.clear();
      const std::int64_t* next = nodes.data();
      for (const std::uint64_t type : types) {
        if (is_vtk_wedge(type)) {
          next += nodes_of(type, at);
          continue;
        }
        std::array<std::uint64_t, 10> rows{};
        const std::size_t row_count = nodes_of(type, at);
        for (std::size_t i = 0; i < row_count; ++i) rows[i] = row_of(part, *next++);
        if (header_.in_parts) {
          add_parts(rows, tets);
          continue;
        }
        tets.push_back({rows[0], rows[1], rows[2], rows[3]});
        for (std::size_t i = 4; i < row_count; ++i) middles.push_back(rows[i]);
      }
      take(tets, middles, types);
    }
  }

  [[nodiscard]] std::uint64_t row_of(std::size_t part, std::int64_t node) const {
    if (node < 0 || static_cast<std::uint64_t>(node) >= point_counts_[part]) {
      connectivity_.fail(text("names point ", node, ", there are ", point_counts_[part]));
    }
    return parts_[part].points + static_cast<std::uint64_t>(node);
  }

  void find_middles() {
    rows_.grow(points_.rows());
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      each_batch(part, [&](const auto&, const Numbers& middles, const auto&) {
        for (const std::uint64_t row : middles) rows_.middle(row);
      });
    }
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      each_batch(part, [&](const std::vector<TetRows>& tets, const auto&, const auto&) {
        for (const TetRows& tet : tets) {
          for (const std::uint64_t row : tet) rows_.keep(row);
        }
      });
    }
    rows_.number();
  }

  void read_points(std::size_t part) {
    const std::uint64_t first = parts_[part].points;
    stream_points(points_, {first, first + point_counts_[part]}, drops_middles() ? &rows_ : nullptr,
                  sink_);
  }

  void read_cells(std::size_t part) {
    std::vector<RawLabel> of_cells, labels;
    std::uint64_t at = parts_[part].cells;
    each_batch(part, [&](std::vector<TetRows>& tets, const auto&, const Numbers& types) {
      if (drops_middles()) {
        for (TetRows& tet : tets) {
          for (std::uint64_t& row : tet) row = rows_[row];
        }
      }
      of_cells.resize(types.size());
      read_labels(*labels_, at, of_cells);
      labels.clear();
      for (std::size_t i = 0; i < types.size(); ++i) {
        if (!is_vtk_wedge(types[i])) labels.insert(labels.end(), parts(), of_cells[i]);
      }
      sink_.write_tets(tets, labels);
      pass_values(at, types);
      at += types.size();
    });
  }

  /// Passes on the values of the tets among the cells of these types.
  void pass_values(std::uint64_t first, const Numbers& types) {
    if (values_.empty()) return;
    std::vector<double> rows(types.size() * parts() * values_.size()), column(types.size());
    std::size_t tets = 0;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      values_[i].read(first, types.size(), column.data());
      tets = 0;
      for (std::size_t cell = 0; cell < types.size(); ++cell) {
        if (is_vtk_wedge(types[cell])) continue;
        for (std::size_t p = 0; p < parts(); ++p) rows[tets++ * values_.size() + i] = column[cell];
      }
    }
    rows.resize(tets * values_.size());
    sink_.write_values(rows);
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
  std::vector<Hdf5Array> values_;
  MeshHeader header_;
  std::vector<Part> parts_;
  Part next_;
  std::uint64_t wedges_ = 0;
  bool ten_nodes_ = false;  ///< some cell has ten nodes
  KeptRows rows_;           ///< the points that stay then
};

/// Reads in a child process, because damage makes the library crash.
void read_here(const std::string& path, MeshSink& sink) {
  const Hdf5Handle file = open_hdf5(path);
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
  read_hdf5_apart(
      exists.name(), exists.size(), [&](MeshSink& out) { read_here(exists.name(), out); }, sink);
}

}  // namespace mw::io
