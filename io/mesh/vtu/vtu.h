// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads and writes tetrahedral .vtu files: the XML of a file written here, with names of labels and
// the record of the run, and where its arrays are.
// Format: https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/file/sink/atomic_file.h"
#include "io/file/source/byte_source.h"
#include "io/mesh/columns.h"
#include "io/mesh/element.h"
#include "io/mesh/field_names.h"
#include "io/mesh/mesh_data.h"
#include "io/mesh/mesh_sink.h"
#include "io/vtk_xml/vtk_document.h"

namespace mw::io {

/// Returns the element FieldData: the arrays of field_names.h where there are names, an array
/// `mwmesh` with the bytes of the record where there is one, and, where there are wedges, an array
/// `cohesive_labels` with the labels under and on top of them by interface.  It is empty without
/// any.  Everything is written as numbers, so nothing needs escaping.
[[nodiscard]] std::string vtu_fields(const MeshHeader& header);

/// Read these arrays, also as VTK's writers have them; return nothing where there are none.
/// ERRORS: mw::Error(kInput) when they are damaged.
[[nodiscard]] LabelNames read_vtu_names(VtkDocument& document);
[[nodiscard]] MeshRecord read_vtu_record(VtkDocument& document);

/// The file: an XML head whose length depends only on its fields (vtu_fields()), values and ids,
/// '_', then for each array a UInt64 byte count and the numbers, little-endian (Float64 for each of
/// the values, UInt64 `cohesive` where there are wedges, UInt8 mask_NAME for each mask
/// (mask_arrays(): 1 for its cells, 0 for others), connectivity Int64 x 4 or 10, offsets Int64,
/// types UInt8, label UInt64 or Int64, points Float64 x 3), then the closing tags.  The points are
/// last, so that all places in front of their end are known before their number is; the ids of
/// nodes (Int64) may follow them.
struct VtuLayout {
  enum Array { kConnectivity, kOffsets, kTypes, kLabel, kPoints, kIds, kArrays };
  std::size_t arrays = kIds;                    ///< how many of them there are
  std::string head;                             ///< up to and including '_'
  std::string tail;                             ///< behind the last array
  std::array<std::uint64_t, kArrays> start{};   ///< file offset of the byte count
  std::array<std::uint64_t, kArrays> length{};  ///< bytes of the numbers
  std::vector<std::uint64_t> values;            ///< like start, for each of MeshHeader::values
  std::uint64_t value_length = 0;               ///< length of each of them and of `cohesive`
  std::optional<std::uint64_t> cohesive;        ///< like start, for that array
  std::vector<std::uint64_t> masks;             ///< like start, for each of MeshRecord::masks
  std::uint64_t mask_length = 0;                ///< length of each of them
  std::uint64_t tail_start = 0;
};

/// The name by which VTK knows ids of points that hold for all pieces of a grid.
inline constexpr const char* kNodeIds = "GlobalNodeIds";
enum class VtuIds : std::uint8_t { kNone, kOfNodes };

/// ENSURES: without ids, head.size() and start do not depend on the number of vertices.
/// Cost: O(names).
[[nodiscard]] VtuLayout make_vtu_layout(const MeshHeader& header, std::uint64_t vertices,
                                        Element element = Element::kTet4,
                                        VtuIds ids = VtuIds::kNone);

/// Reads a mesh, with its pieces one after the other.  Tets with ten nodes are read by their
/// corners, without the middles of edges; curved ones become kTetParts.  The label is the cell
/// array `label`, else `Label`, `labels`, `material` or `medit:ref`, else the only integer cell
/// array.  Cell arrays of floats with one component are values (value_names()).
/// ERRORS: mw::Error(kInput) with file and place when truncated or corrupt, for cells that are not
/// tetrahedra, without label, or when a row does not exist.
[[nodiscard]] MeshData read_vtu(const ByteSource& source);

/// A mesh that is part of another.
struct VtuPiece {
  MeshData mesh;
  std::vector<std::uint64_t> ids;  ///< PointData/GlobalNodeIds: its vertices in the whole mesh
};

/// Reads a piece.  ERRORS: those of read_vtu(); also without ids, or with tets of ten nodes.
[[nodiscard]] VtuPiece read_vtu_piece(const ByteSource& source);

/// Writes a .vtu file.  Cost: the buffers of MeshColumns; every number is copied once.
class VtuSink : public ColumnSink {
 public:
  explicit VtuSink(const std::filesystem::path& path, Element element = Element::kTet4)
      : ColumnSink(element), name_(path.string()), file_(path) {}

  void begin(const MeshHeader& header) override;
  void finish() override;
  [[nodiscard]] std::uint64_t buffer_bytes() const override { return 3 << 20; }

 private:
  std::string name_;
  AtomicFile file_;
};

}  // namespace mw::io
