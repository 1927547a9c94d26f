// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A .vtkhdf file that several processes write together.
#pragma once

#include <filesystem>
#include <optional>

#include "io/file/joined_partial.h"
#include "io/mesh/vtkhdf/vtkhdf_columns.h"

namespace mw::io {

/// The bytes of VtkhdfSink: its columns are in one piece each, so that every row has a place that
/// all processes know once tets and vertices are counted.  Tets of four nodes.
class VtkhdfShared : public SharedMesh {
 public:
  /// Touches no file.
  explicit VtkhdfShared(std::filesystem::path path) : path_(std::move(path)) {}

  void create() override;
  [[nodiscard]] std::string place() const override { return partial_.string(); }
  void join(const std::string& place) override;
  void lay_out(const MeshHeader& header, std::uint64_t vertices) override;
  void begin(std::uint64_t tets) override;
  void go_to(const RowPlace& rows) override { columns_.go_to(rows); }
  void write_vertices(std::span<const Position> positions) override {
    columns_.write_vertices(positions);
  }
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) override {
    columns_.write_tets(tets, labels);
  }
  void sync() override;
  void finish() override;
  [[nodiscard]] std::uint64_t buffer_bytes() const override { return 4 << 20; }

 private:
  std::filesystem::path path_;
  std::optional<Hdf5Output> made_;  ///< by the maker
  MeshHeader header_;               ///< the maker's
  std::uint64_t vertices_ = 0;      ///< the maker's
  std::filesystem::path partial_;
  std::optional<JoinedPartial> part_;  ///< what rows are written through
  VtkhdfColumns columns_;
};

}  // namespace mw::io
