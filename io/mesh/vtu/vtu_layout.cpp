// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a .vtu file written here looks like.
#include "io/mesh/vtu/vtu_layout.h"

#include "io/file/errors.h"

namespace mw::io {
namespace {

struct ArrayTag {
  const char* before;  ///< tags that open or close around it
  const char* type;
  const char* name;
  int components;
};

std::array<ArrayTag, VtuLayout::kArrays> array_tags(bool labels_signed) {
  return {{{"      <Points>\n", "Float64", "Points", 3},
           {"      </Points>\n      <Cells>\n", "Int64", "connectivity", 1},
           {"", "Int64", "offsets", 1},
           {"", "UInt8", "types", 1},
           {"      </Cells>\n      <CellData Scalars=\"label\">\n",
            labels_signed ? "Int64" : "UInt64", "label", 1}}};
}

}  // namespace

VtuLayout make_vtu_layout(const MeshHeader& header) {
  VtuLayout layout;
  layout.length = {header.vertices * 24, header.tets * 32, header.tets * 8, header.tets,
                   header.tets * 8};
  layout.head = text(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  <UnstructuredGrid>\n"
      "    <Piece NumberOfPoints=\"",
      header.vertices, "\" NumberOfCells=\"", header.tets, "\">\n");
  const auto tags = array_tags(header.labels_signed);
  std::uint64_t offset = 0;
  for (std::size_t i = 0; i < VtuLayout::kArrays; ++i) {
    layout.head += text(tags[i].before, "        <DataArray type=\"", tags[i].type, "\" Name=\"",
                        tags[i].name, "\" NumberOfComponents=\"", tags[i].components,
                        "\" format=\"appended\" offset=\"", offset, "\"/>\n");
    layout.start[i] = offset;
    offset += 8 + layout.length[i];
  }
  layout.head +=
      "      </CellData>\n    </Piece>\n  </UnstructuredGrid>\n"
      "  <AppendedData encoding=\"raw\">\n_";
  layout.tail = "\n  </AppendedData>\n</VTKFile>\n";
  for (std::uint64_t& start : layout.start) start += layout.head.size();
  layout.tail_start = layout.head.size() + offset;
  return layout;
}

}  // namespace mw::io
