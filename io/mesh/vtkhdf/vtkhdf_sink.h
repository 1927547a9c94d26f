// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Streams a mesh into a .vtkhdf file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/mesh/mesh_sink.h"
#include "io/mesh/vtkhdf/atomic_file_driver.h"

namespace mw::io {

/// How numbers lie in the file and in memory; of one signedness, since HDF5 clamps when it differs.
struct Hdf5Type {
  hid_t file = H5I_INVALID_HID;
  hid_t memory = H5I_INVALID_HID;
};

/// A chunked data set that grows at its end, one whole chunk at a time.
template <class T>
class Hdf5Column {
 public:
  Hdf5Column() = default;
  /// REQUIRES: the HDF5 file is open.  rows_per_chunk >= 1; components 1 means one dimension.
  Hdf5Column(hid_t place, const char* name, Hdf5Type type, hsize_t rows_per_chunk,
             hsize_t components = 1);
  void add(T value) { buffer_.push_back(value); }
  /// After each row.
  void end_row() {
    if (buffer_.size() == rows_per_chunk_ * components_) flush();
  }
  /// Writes what is left; whether all went well.
  bool finish();

 private:
  void flush();

  Hdf5Handle set_;
  hid_t memory_type_ = H5I_INVALID_HID;
  hsize_t rows_per_chunk_ = 0;
  hsize_t components_ = 1;
  hsize_t rows_ = 0;  ///< written
  std::vector<T> buffer_;
  bool sound_ = true;
};

/// VTKHDF 1.0, one UnstructuredGrid of one partition, which VTK 9.1 and ParaView 5.11 read:
///   /VTKHDF              attributes Version = (1, 0), Type = "UnstructuredGrid"
///     NumberOfPoints, NumberOfCells, NumberOfConnectivityIds   Int64, 1 element
///     Points             Float64 [vertices][3]
///     Connectivity       Int64 [4 tets]
///     Offsets            Int64 [tets + 1]
///     Types              UInt8 [tets], all 10
///     CellData/label     UInt64 or Int64 [tets]
///     FieldData          names of labels, where there are any, as in /mwmesh (vtkhdf_names.h)
/// No time stamps: equal meshes are equal bytes.
/// Cost: 4 MiB of buffers and as much inside HDF5.  Thread safety: see Hdf5Handle.
class VtkhdfSink : public MeshSink {
 public:
  explicit VtkhdfSink(const std::filesystem::path& path);

  void begin(const MeshHeader& header) override;
  void write_vertices(std::span<const Position> positions) override;
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) override;
  void finish() override;
  [[nodiscard]] std::uint64_t buffer_bytes() const override { return 10 << 20; }

 private:
  void require(bool done) const;
  void write_attributes() const;
  void write_count(const char* name, std::uint64_t count) const;

  std::string name_;
  AtomicFile file_;
  Hdf5Target target_;
  Hdf5Handle hdf5_;
  Hdf5Handle group_;
  MeshHeader header_;
  Hdf5Column<double> points_;
  Hdf5Column<std::uint64_t> connectivity_;
  Hdf5Column<std::uint64_t> offsets_;
  Hdf5Column<std::uint8_t> types_;
  Hdf5Column<std::uint64_t> labels_;
  std::uint64_t vertices_ = 0;
  std::uint64_t tets_ = 0;
};

}  // namespace mw::io
