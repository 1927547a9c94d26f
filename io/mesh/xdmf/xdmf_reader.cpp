// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads a tetrahedral XDMF file over HDF5.
#include "io/mesh/xdmf/xdmf_reader.h"

#include <algorithm>
#include <optional>

#include "io/file/errors.h"
#include "io/mesh/apart_mesh.h"
#include "io/mesh/field_names.h"
#include "io/mesh/grouped/label_numbers.h"
#include "io/mesh/vtkhdf/hdf5_mesh.h"
#include "io/mesh/xdmf/xdmf_grid.h"

namespace mw::io {
namespace {

Hdf5Array open_array(const XdmfItem& item) {
  // The data set keeps the file open.
  const Hdf5Handle file = open_hdf5(item.file.string());
  return Hdf5Array(file.get(), item.path, item.file.string());
}

std::optional<Hdf5Array> label_array(const XdmfGrid& grid) {
  std::vector<std::string> integers;
  for (const XdmfAttribute& attribute : grid.cells) {
    const Hdf5Array array = open_array(attribute.item);
    if (array.is_integer() && array.components() == 1) integers.push_back(attribute.name);
  }
  const std::string* name = choose_label(integers);
  if (name == nullptr) return std::nullopt;
  const auto found = std::find_if(grid.cells.begin(), grid.cells.end(),
                                  [&](const XdmfAttribute& a) { return a.name == *name; });
  return open_array(found->item);
}

class Reader {
 public:
  Reader(const XdmfGrid& grid, const Hdf5Array& labels, MeshSink& sink)
      : tets_(open_array(grid.topology)),
        points_(open_array(grid.geometry)),
        labels_(labels),
        sink_(sink) {}

  /// header: names and record.
  void read(MeshHeader header) {
    check_arrays();
    header.tets = tets_.rows();
    header.labels_signed = labels_.is_signed();
    sink_.begin(header);
    const bool ten = tets_.components() == 10;
    if (ten) find_middles();
    stream_points(points_, {0, points_.rows()}, ten ? &rows_ : nullptr, sink_);
    read_cells(ten);
    sink_.finish();
  }

 private:
  void check_arrays() const {
    if (!tets_.is_integer() || (tets_.components() != 4 && tets_.components() != 10)) {
      tets_.fail("holds no rows of 4 or 10 nodes");
    }
    if (points_.components() != 3) points_.fail("not of 3 components");
    if (labels_.rows() != tets_.rows()) {
      labels_.fail(text("has ", labels_.rows(), " rows, there are ", tets_.rows(), " tets"));
    }
  }

  /// Calls take(nodes) on batches of whole rows.
  template <class Take>
  void each_batch(Take take) const {
    std::vector<std::int64_t> nodes;
    for (std::uint64_t at = 0; at < tets_.rows();) {
      const std::uint64_t count = std::min(kMaxApartRows, tets_.rows() - at);
      nodes.resize(count * tets_.components());
      tets_.read(at, count, nodes.data());
      for (const std::int64_t node : nodes) {
        if (node >= 0 && static_cast<std::uint64_t>(node) < points_.rows()) continue;
        tets_.fail(text("names node ", node, ", there are ", points_.rows()));
      }
      take(nodes);
      at += count;
    }
  }

  void find_middles() {
    rows_.grow(points_.rows());
    const auto is_corner = [](std::size_t i) { return i % 10 < 4; };
    each_batch([&](const std::vector<std::int64_t>& nodes) {
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (!is_corner(i)) rows_.middle(static_cast<std::uint64_t>(nodes[i]));
      }
    });
    each_batch([&](const std::vector<std::int64_t>& nodes) {
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (is_corner(i)) rows_.corner(static_cast<std::uint64_t>(nodes[i]));
      }
    });
    rows_.number();
  }

  void read_cells(bool ten) {
    std::vector<TetRows> tets;
    std::vector<RawLabel> labels;
    std::uint64_t first = 0;
    each_batch([&](const std::vector<std::int64_t>& nodes) {
      tets.resize(nodes.size() / tets_.components());
      for (std::size_t t = 0; t < tets.size(); ++t) {
        for (std::size_t i = 0; i < 4; ++i) {
          const auto row = static_cast<std::uint64_t>(nodes[t * tets_.components() + i]);
          tets[t][i] = ten ? rows_[row] : row;
        }
      }
      labels.resize(tets.size());
      read_labels(labels_, first, labels);
      sink_.write_tets(tets, labels);
      first += tets.size();
    });
  }

  Hdf5Array tets_;
  Hdf5Array points_;
  const Hdf5Array& labels_;
  MeshSink& sink_;
  KeptRows rows_;  ///< what stays of nodes when tets have ten
};

/// In a child: damage makes the library crash.
void read_here(const std::filesystem::path& path, const std::vector<XdmfGrid>& grids,
               const MeshHeader& facts, MeshSink& sink) {
  for (const XdmfGrid& grid : grids) {
    const std::optional<Hdf5Array> labels = label_array(grid);
    if (labels) return Reader(grid, *labels, sink).read(facts);
  }
  fail_input(path.string(), "grids",
             text("none of ", grids.size(), " of tetrahedra has an integer cell attribute 'label'"),
             "store the labels as one");
}

}  // namespace

void read_xdmf(const std::filesystem::path& path, MeshSink& sink) {
  const XdmfContent content = read_xdmf_xml(path);
  const std::optional<LabelMap> table = read_label_table(path);
  MeshHeader facts;
  if (table) facts.names = table->names;
  facts.record = content.record;
  std::uint64_t bytes = 0;
  for (const XdmfGrid& grid : content.grids)
    bytes += std::filesystem::file_size(grid.topology.file);
  read_hdf5_apart(
      path.string(), bytes, [&](MeshSink& out) { read_here(path, content.grids, facts, out); },
      sink);
}

}  // namespace mw::io
