// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads what the writers of solvers' formats wrote.
#include "tests/io/mesh/read_back.h"

#include <hdf5.h>
#include <netcdf.h>

#include <iomanip>
#include <pugixml.hpp>

#include "io/mesh/grouped/label_numbers.h"
#include "tests/temp_folder.h"
#include "tests/testing.h"

namespace mw::io {
namespace {

using Nodes = std::vector<std::uint64_t>;  ///< of a tet, rows from 0 on

/// Nodes are 4 or 10.
void add_tet(MeshData& mesh, const Nodes& nodes, RawLabel label) {
  mesh.tets.push_back({nodes.at(0), nodes.at(1), nodes.at(2), nodes.at(3)});
  mesh.labels.push_back(label);
}

/// Checks and drops the nodes behind the corners.
void drop_middles(MeshData& mesh, const std::vector<Nodes>& tets) {
  constexpr std::size_t kEnds[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  std::size_t kept = mesh.vertices.size();
  for (const Nodes& tet : tets) {
    for (std::size_t i = 4; i < tet.size(); ++i) {
      kept = std::min<std::size_t>(kept, tet[i]);
      for (std::size_t k = 0; k < 3; ++k) {
        const double a = mesh.vertices.at(tet[kEnds[i - 4][0]])[k];
        const double b = mesh.vertices.at(tet[kEnds[i - 4][1]])[k];
        EXPECT_NEAR(mesh.vertices.at(tet[i])[k], (a + b) / 2, 1e-12 * (std::abs(a) + std::abs(b)));
      }
    }
  }
  for (const Nodes& tet : tets) {
    for (std::size_t i = 0; i < 4; ++i) EXPECT_LT(tet[i], kept);
  }
  mesh.vertices.resize(kept);
}

std::vector<std::string> split(const std::string& line) {
  std::istringstream items(line);
  std::vector<std::string> out;
  for (std::string item; std::getline(items, item, ',');) out.push_back(item);
  return out;
}

Position position_of(const std::vector<std::string>& items, std::size_t first) {
  return {std::stod(items.at(first)), std::stod(items.at(first + 1)),
          std::stod(items.at(first + 2))};
}

/// From 1 on in the file.
Nodes nodes_of(const std::vector<std::string>& items, std::size_t first) {
  Nodes out;
  for (std::size_t i = first; i < items.size(); ++i) out.push_back(std::stoull(items[i]) - 1);
  return out;
}

/// `** SET: label -7 "name" 1 2 3 4`
LabelName name_in(const std::string& comment) {
  std::istringstream words(comment.substr(comment.find(": label ") + 8));
  std::string label;
  LabelName out;
  words >> label >> std::quoted(out.name);
  out.label = label[0] == '-' ? static_cast<RawLabel>(std::stoll(label)) : std::stoull(label);
  std::array<int, 4> colour{};
  if (!(words >> colour[0] >> colour[1] >> colour[2] >> colour[3])) return out;
  out.colour.emplace();
  std::copy(colour.begin(), colour.end(), out.colour->begin());
  return out;
}

/// "LABEL_7", "LABEL_M7" of -7.
RawLabel label_of_set(const std::string& set) {
  EXPECT_TRUE(set.starts_with("LABEL_")) << set;
  const bool below_zero = set.starts_with("LABEL_M");
  const RawLabel size = std::stoull(set.substr(below_zero ? 7 : 6));
  return below_zero ? RawLabel{0} - size : size;
}

MeshData read_inp(const std::filesystem::path& path) {
  std::istringstream lines(test::content_of(path));
  MeshData mesh;
  std::vector<LabelName> names;
  std::map<std::string, RawLabel> named;  // by set
  std::vector<Nodes> tets;
  std::string line, keyword, set;
  while (std::getline(lines, line)) {
    if (const std::size_t at = line.find(": label "); line.starts_with("** ") && at < 84) {
      names.push_back(name_in(line));
      named[line.substr(3, at - 3)] = names.back().label;
    }
    if (line.starts_with("**")) continue;
    if (line.starts_with("*")) {
      keyword = line.substr(0, line.find(','));
      const std::size_t at = line.find("ELSET=");
      if (at != line.npos) set = line.substr(at + 6);
      continue;
    }
    const std::vector<std::string> items = split(line);
    if (keyword == "*NODE") {
      EXPECT_EQ(std::stoull(items[0]), mesh.vertices.size() + 1);
      mesh.vertices.push_back(position_of(items, 1));
    } else if (keyword == "*ELEMENT") {
      tets.push_back(nodes_of(items, 1));
      mesh.labels_signed = mesh.labels_signed || set.starts_with("LABEL_M");
      add_tet(mesh, tets.back(), named.contains(set) ? named[set] : label_of_set(set));
    }
  }
  drop_middles(mesh, tets);
  mesh.names = LabelNames(std::move(names));
  return mesh;
}

MeshData read_feb(const std::filesystem::path& path) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_file(path.c_str()));
  const pugi::xml_node model = document.child("febio_spec");
  const LabelMap table = read_label_table(path).value();
  MeshData mesh;
  for (const pugi::xml_node node : model.child("Mesh").child("Nodes")) {
    mesh.vertices.push_back(position_of(split(node.text().get()), 0));
  }
  std::map<std::string, std::int64_t> materials, parts;
  for (const pugi::xml_node row : model.child("Material")) {
    materials[row.attribute("name").value()] = row.attribute("id").as_llong();
  }
  for (const pugi::xml_node domain : model.child("MeshDomains")) {
    parts[domain.attribute("name").value()] = materials.at(domain.attribute("mat").value());
  }
  std::vector<Nodes> tets;
  for (const pugi::xml_node part : model.child("Mesh").children("Elements")) {
    for (const pugi::xml_node element : part) {
      tets.push_back(nodes_of(split(element.text().get()), 0));
      add_tet(mesh, tets.back(), table.labels.at(parts.at(part.attribute("name").value())));
    }
  }
  drop_middles(mesh, tets);
  mesh.labels_signed = table.labels_signed;
  mesh.names = table.names;
  return mesh;
}

MeshData read_xdmf(const std::filesystem::path& path) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_file(path.c_str()));
  const pugi::xml_node domain = document.child("Xdmf").child("Domain");
  const auto grid = domain.find_child_by_attribute("Grid", "Name", "mesh");
  const auto numbers = std::filesystem::path(path).replace_extension(".h5");
  const auto points = hdf5_numbers<double>(numbers, "/Mesh/mesh/geometry");
  const auto nodes = hdf5_numbers<std::int64_t>(numbers, "/Mesh/mesh/topology");
  const auto labels = hdf5_numbers<std::int64_t>(numbers, "/Mesh/mesh/label");
  MeshData mesh;
  for (std::size_t i = 0; i < points.size(); i += 3) {
    mesh.vertices.push_back({points[i], points[i + 1], points[i + 2]});
  }
  const auto width = grid.child("Topology").attribute("NodesPerElement").as_uint();
  std::vector<Nodes> tets;
  for (std::size_t t = 0; t < labels.size(); ++t) {
    const auto first = nodes.begin() + static_cast<std::ptrdiff_t>(t * width);
    tets.emplace_back(first, first + width);
    add_tet(mesh, tets.back(), static_cast<RawLabel>(labels[t]));
  }
  drop_middles(mesh, tets);
  const auto label = grid.find_child_by_attribute("Attribute", "Name", "label");
  mesh.labels_signed =
      label.child("DataItem").attribute("NumberType").value() == std::string("Int");
  mesh.names = read_label_table(path).value().names;
  const auto record = domain.find_child_by_attribute("Information", "Name", "mwmesh");
  mesh.record = parse_record(record.attribute("Value").value(), path.string());
  return mesh;
}

/// An Exodus II file, by the netCDF library.
class ExodusFile {
 public:
  explicit ExodusFile(const std::filesystem::path& path) {
    EXPECT_EQ(nc_open(path.c_str(), NC_NOWRITE, &file_), NC_NOERR);
  }
  ExodusFile(const ExodusFile&) = delete;
  ExodusFile& operator=(const ExodusFile&) = delete;
  ~ExodusFile() { nc_close(file_); }

  /// 0 where there is no such dimension.
  [[nodiscard]] std::size_t length(const std::string& dimension) const {
    int id = 0;
    std::size_t out = 0;
    if (nc_inq_dimid(file_, dimension.c_str(), &id) == NC_NOERR) nc_inq_dimlen(file_, id, &out);
    return out;
  }
  [[nodiscard]] std::vector<int> integers(const std::string& name, std::size_t count) const {
    std::vector<int> out(count);
    if (count == 0) return out;
    EXPECT_EQ(nc_get_var_int(file_, id_of(name), out.data()), NC_NOERR) << name;
    return out;
  }
  [[nodiscard]] std::vector<double> reals(const std::string& name, std::size_t count) const {
    std::vector<double> out(count);
    if (count == 0) return out;
    EXPECT_EQ(nc_get_var_double(file_, id_of(name), out.data()), NC_NOERR) << name;
    return out;
  }

 private:
  [[nodiscard]] int id_of(const std::string& name) const {
    int id = -1;
    EXPECT_EQ(nc_inq_varid(file_, name.c_str(), &id), NC_NOERR) << name;
    return id;
  }

  int file_ = -1;
};

MeshData read_exo(const std::filesystem::path& path) {
  const ExodusFile file(path);
  const LabelMap table = read_label_table(path).value();
  MeshData mesh;
  mesh.vertices.resize(file.length("num_nodes"));
  for (std::size_t k = 0; k < 3; ++k) {
    const auto values = file.reals(std::string("coord") + "xyz"[k], mesh.vertices.size());
    for (std::size_t row = 0; row < values.size(); ++row) mesh.vertices[row][k] = values[row];
  }
  const std::size_t blocks = file.length("num_el_blk");
  const std::vector<int> ids = file.integers("eb_prop1", blocks);
  std::vector<Nodes> tets;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::string number = std::to_string(b + 1);
    const std::size_t width = file.length("num_nod_per_el" + number);
    const std::size_t count = file.length("num_el_in_blk" + number);
    const std::vector<int> nodes = file.integers("connect" + number, count * width);
    for (std::size_t t = 0; t < count; ++t) {
      Nodes tet;
      for (std::size_t i = 0; i < width; ++i) {
        tet.push_back(static_cast<std::uint64_t>(nodes[t * width + i]) - 1);
      }
      add_tet(mesh, tet, table.labels.at(ids[b]));
      tets.push_back(std::move(tet));
    }
  }
  EXPECT_EQ(mesh.tets.size(), file.length("num_elem"));
  drop_middles(mesh, tets);
  mesh.labels_signed = table.labels_signed;
  mesh.names = table.names;
  return mesh;
}

/// Fields of 8 columns, or 16 in the lines of a card that has an asterisk.
std::string field_of(const std::string& line, std::size_t first, std::size_t columns) {
  return line.substr(first, columns);
}

MeshData read_bdf(const std::filesystem::path& path) {
  std::istringstream lines(test::content_of(path));
  const LabelMap table = read_label_table(path).value();
  MeshData mesh;
  std::vector<Nodes> tets;
  std::vector<std::int64_t> parts;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("GRID*")) {
      std::string more;
      std::getline(lines, more);
      EXPECT_EQ(std::stoull(field_of(line, 8, 16)), mesh.vertices.size() + 1);
      mesh.vertices.push_back({std::stod(field_of(line, 40, 16)), std::stod(field_of(line, 56, 16)),
                               std::stod(field_of(more, 8, 16))});
    } else if (line.starts_with("CTETRA")) {
      parts.push_back(std::stoll(field_of(line, 16, 8)));
      tets.emplace_back();
      for (std::size_t at = 24; at + 8 <= line.size(); at += 8) {
        tets.back().push_back(std::stoull(field_of(line, at, 8)) - 1);
      }
    } else if (line.starts_with("+")) {
      for (std::size_t at = 8; at + 8 <= line.size(); at += 8) {
        tets.back().push_back(std::stoull(field_of(line, at, 8)) - 1);
      }
    }
  }
  for (std::size_t t = 0; t < tets.size(); ++t) {
    add_tet(mesh, tets[t], table.labels.at(parts[t]));
  }
  mesh.labels_signed = table.labels_signed;
  mesh.names = table.names;
  return mesh;
}

std::vector<std::uint64_t> integers_of(const std::string& line, std::size_t columns) {
  std::vector<std::uint64_t> out;
  for (std::size_t at = 0; at + columns <= line.size(); at += columns) {
    out.push_back(std::stoull(field_of(line, at, columns)));
  }
  return out;
}

/// Three reals behind `first` columns.
Position position_of(const std::string& line, std::size_t first, std::size_t columns) {
  Position out{};
  for (std::size_t i = 0; i < 3; ++i) {
    out[i] = std::stod(field_of(line, first + i * columns, columns));
  }
  return out;
}

MeshData read_k(const std::filesystem::path& path) {
  std::istringstream lines(test::content_of(path));
  const LabelMap table = read_label_table(path).value();
  MeshData mesh;
  std::string card;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('*')) {
      card = line;
    } else if (card == "*NODE") {
      mesh.vertices.push_back(position_of(line, 8, 16));
    } else if (card == "*ELEMENT_SOLID") {
      const std::vector<std::uint64_t> head = integers_of(line, 8);
      std::string more;
      if (head.size() == 2) std::getline(lines, more);
      Nodes nodes = integers_of(head.size() == 2 ? more : line.substr(16), 8);
      for (std::uint64_t& node : nodes) --node;
      nodes.resize(head.size() == 2 ? 10 : 4);
      add_tet(mesh, nodes, table.labels.at(static_cast<std::int64_t>(head[1])));
    }
  }
  mesh.labels_signed = table.labels_signed;
  mesh.names = table.names;
  return mesh;
}

MeshData read_cdb(const std::filesystem::path& path) {
  std::istringstream lines(test::content_of(path));
  const LabelMap table = read_label_table(path).value();
  MeshData mesh;
  std::string block;
  for (std::string line; std::getline(lines, line);) {
    const bool begins = line.starts_with("NBLOCK") || line.starts_with("EBLOCK");
    if (begins || line.starts_with("N,") || line == "       -1") {
      block = begins ? line.substr(0, 6) : "";
      if (begins) std::getline(lines, line);
    } else if (block == "NBLOCK") {
      mesh.vertices.push_back(position_of(line, 27, 21));
    } else if (block == "EBLOCK") {
      constexpr std::size_t kHead = 11, kType = 1, kNodes = 8;
      std::vector<std::uint64_t> row = integers_of(line, 9);
      if (row[kNodes] > 8) {
        std::getline(lines, line);
        for (const std::uint64_t node : integers_of(line, 9)) row.push_back(node);
      }
      EXPECT_EQ(row.size(), kHead + row[kNodes]);
      if (row[kType] != 1) continue;  // a triangle
      Nodes nodes(row.begin() + kHead, row.end());
      for (std::uint64_t& node : nodes) --node;
      add_tet(mesh, nodes, table.labels.at(static_cast<std::int64_t>(row[0])));
    }
  }
  mesh.labels_signed = table.labels_signed;
  mesh.names = table.names;
  return mesh;
}

}  // namespace

template <class T>
std::vector<T> hdf5_numbers(const std::filesystem::path& file, const char* data_set) {
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t set = H5Dopen2(opened, data_set, H5P_DEFAULT);
  const hid_t space = H5Dget_space(set);
  const hid_t stored = H5Dget_type(set);
  constexpr bool kReal = std::is_floating_point_v<T>;
  // Labels of 2^63 and more would be clamped to the largest signed number.
  const bool has_no_sign = !kReal && H5Tget_sign(stored) == H5T_SGN_NONE;
  const hid_t wanted = kReal         ? H5T_NATIVE_DOUBLE
                       : has_no_sign ? H5T_NATIVE_UINT64
                                     : H5T_NATIVE_INT64;
  std::vector<T> numbers(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  EXPECT_GE(H5Dread(set, wanted, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()), 0);
  H5Tclose(stored);
  H5Sclose(space);
  H5Dclose(set);
  H5Fclose(opened);
  return numbers;
}

template std::vector<double> hdf5_numbers(const std::filesystem::path&, const char*);
template std::vector<std::int64_t> hdf5_numbers(const std::filesystem::path&, const char*);

MeshData read_back(const std::filesystem::path& path) {
  if (path.extension() == ".inp") return read_inp(path);
  if (path.extension() == ".feb") return read_feb(path);
  if (path.extension() == ".exo") return read_exo(path);
  if (path.extension() == ".bdf") return read_bdf(path);
  if (path.extension() == ".k") return read_k(path);
  if (path.extension() == ".cdb") return read_cdb(path);
  if (path.extension() == ".xdmf") return read_xdmf(path);
  return read_mesh(path);
}

}  // namespace mw::io
