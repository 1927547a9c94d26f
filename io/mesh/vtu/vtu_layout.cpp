// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a .vtu file written here looks like.
#include "io/mesh/vtu/vtu_layout.h"

#include <string_view>

#include "io/file/errors.h"
#include "io/mesh/vtu/vtu_names.h"
#include "kernels/core/assert.h"

namespace mw::io {
namespace {

/// Longer than any head without its fields and ids.
constexpr std::size_t kHeadBytes = 1536;
constexpr std::string_view kAppended = "  <AppendedData encoding=\"raw\">\n_";

/// A single component is not told: meshio makes columns of numbers of it, which nobody expects.
std::string array_tag(const char* type, const char* name, int components, std::uint64_t offset) {
  const std::string told = components == 1 ? "" : text(" NumberOfComponents=\"", components, "\"");
  return text("        <DataArray type=\"", type, "\" Name=\"", name, "\"", told,
              " format=\"appended\" offset=\"", offset, "\"/>\n");
}

std::string ids_element(std::uint64_t offset) {
  return text("      <PointData GlobalIds=\"", kNodeIds, "\">\n",
              array_tag("Int64", kNodeIds, 1, offset), "      </PointData>\n");
}

/// `offset` of each array is relative to the '_'.
std::string make_head(const MeshHeader& header, std::uint64_t vertices, const std::string& fields,
                      const std::string& ids,
                      const std::array<std::uint64_t, VtuLayout::kArrays>& offset) {
  std::string head = text(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  <UnstructuredGrid>\n",
      fields, "    <Piece NumberOfPoints=\"", vertices, "\" NumberOfCells=\"", header.tets, "\">\n",
      ids, "      <Points>\n", array_tag("Float64", "Points", 3, offset[VtuLayout::kPoints]),
      "      </Points>\n      <Cells>\n",
      array_tag("Int64", "connectivity", 1, offset[VtuLayout::kConnectivity]),
      array_tag("Int64", "offsets", 1, offset[VtuLayout::kOffsets]),
      array_tag("UInt8", "types", 1, offset[VtuLayout::kTypes]),
      "      </Cells>\n      <CellData Scalars=\"label\">\n",
      array_tag(header.labels_signed ? "Int64" : "UInt64", "label", 1, offset[VtuLayout::kLabel]),
      "      </CellData>\n    </Piece>\n  </UnstructuredGrid>\n");
  const std::size_t bytes = kHeadBytes + fields.size() + ids.size();
  MW_ASSERT(head.size() + kAppended.size() <= bytes);
  head.resize(bytes - kAppended.size(), ' ');
  head.back() = '\n';
  return head.append(kAppended);
}

}  // namespace

VtuLayout make_vtu_layout(const MeshHeader& header, std::uint64_t vertices, Element element,
                          VtuIds with_ids) {
  const std::string fields = vtu_fields(header);
  VtuLayout layout;
  layout.length = {header.tets * 8 * node_count(element),
                   header.tets * 8,
                   header.tets,
                   header.tets * 8,
                   vertices * 24,
                   vertices * 8};
  if (with_ids == VtuIds::kOfNodes) layout.arrays = VtuLayout::kArrays;
  std::array<std::uint64_t, VtuLayout::kArrays> offset{};
  std::uint64_t next = 0;
  for (std::size_t i = 0; i < layout.arrays; ++i) {
    offset[i] = next;
    next += 8 + layout.length[i];
  }
  const std::string ids = with_ids == VtuIds::kNone ? "" : ids_element(offset[VtuLayout::kIds]);
  layout.head = make_head(header, vertices, fields, ids, offset);
  for (std::size_t i = 0; i < layout.arrays; ++i) layout.start[i] = layout.head.size() + offset[i];
  layout.tail = "\n  </AppendedData>\n</VTKFile>\n";
  layout.tail_start = layout.head.size() + next;
  return layout;
}

}  // namespace mw::io
