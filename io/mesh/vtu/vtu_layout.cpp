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

/// Longer than any head without its fields.
constexpr std::size_t kHeadBytes = 1536;
constexpr std::string_view kAppended = "  <AppendedData encoding=\"raw\">\n_";

/// A single component is not told: meshio makes columns of numbers of it, which nobody expects.
std::string array_tag(const char* type, const char* name, int components, std::uint64_t offset) {
  const std::string told = components == 1 ? "" : text(" NumberOfComponents=\"", components, "\"");
  return text("        <DataArray type=\"", type, "\" Name=\"", name, "\"", told,
              " format=\"appended\" offset=\"", offset, "\"/>\n");
}

/// `offset` of each array is relative to the '_'.
std::string make_head(const MeshHeader& header, std::uint64_t vertices, const std::string& fields,
                      const std::array<std::uint64_t, VtuLayout::kArrays>& offset) {
  std::string head = text(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  <UnstructuredGrid>\n",
      fields, "    <Piece NumberOfPoints=\"", vertices, "\" NumberOfCells=\"", header.tets,
      "\">\n      <Points>\n", array_tag("Float64", "Points", 3, offset[VtuLayout::kPoints]),
      "      </Points>\n      <Cells>\n",
      array_tag("Int64", "connectivity", 1, offset[VtuLayout::kConnectivity]),
      array_tag("Int64", "offsets", 1, offset[VtuLayout::kOffsets]),
      array_tag("UInt8", "types", 1, offset[VtuLayout::kTypes]),
      "      </Cells>\n      <CellData Scalars=\"label\">\n",
      array_tag(header.labels_signed ? "Int64" : "UInt64", "label", 1, offset[VtuLayout::kLabel]),
      "      </CellData>\n    </Piece>\n  </UnstructuredGrid>\n");
  const std::size_t bytes = kHeadBytes + fields.size();
  MW_ASSERT(head.size() + kAppended.size() <= bytes);
  head.resize(bytes - kAppended.size(), ' ');
  head.back() = '\n';
  return head.append(kAppended);
}

}  // namespace

VtuLayout make_vtu_layout(const MeshHeader& header, std::uint64_t vertices, Element element) {
  const std::string fields = vtu_fields(header);
  const std::uint64_t head_bytes = kHeadBytes + fields.size();
  VtuLayout layout;
  layout.length = {header.tets * 8 * node_count(element), header.tets * 8, header.tets,
                   header.tets * 8, vertices * 24};
  std::array<std::uint64_t, VtuLayout::kArrays> offset{};
  std::uint64_t next = 0;
  for (std::size_t i = 0; i < VtuLayout::kArrays; ++i) {
    offset[i] = next;
    layout.start[i] = head_bytes + next;
    next += 8 + layout.length[i];
  }
  layout.head = make_head(header, vertices, fields, offset);
  layout.tail = "\n  </AppendedData>\n</VTKFile>\n";
  layout.tail_start = head_bytes + next;
  return layout;
}

}  // namespace mw::io
