// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads data sets of numbers in an HDF5 file by rows, and meshes that are made of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "io/hdf5/hdf5_file.h"
#include "io/mesh/grouped/grouped_mesh.h"
#include "io/mesh/kept_rows.h"

namespace mw::io {

/// A data set of one or two dimensions, whose numbers are converted to what the reader asks for.
class Hdf5Array {
 public:
  /// ERRORS (all members): mw::Error(kInput) naming file and data set; here when it is missing, no
  /// array of numbers, not in the file itself, announces more than its bytes can hold, or has a
  /// packed chunk that is damaged or short.
  Hdf5Array(hid_t where, const std::string& path, const std::string& file);

  [[nodiscard]] std::uint64_t rows() const { return rows_; }
  [[nodiscard]] std::uint64_t components() const { return components_; }
  [[nodiscard]] bool is_integer() const { return is_integer_; }
  [[nodiscard]] bool is_signed() const { return is_signed_; }

  /// Reads rows, which are count * components() numbers.  ERRORS: also when there are fewer rows.
  void read(std::uint64_t first, std::uint64_t count, double* out) const;
  /// Likewise; numbers outside the type are clamped.  REQUIRES (both): is_integer().
  void read(std::uint64_t first, std::uint64_t count, std::int64_t* out) const;
  void read(std::uint64_t first, std::uint64_t count, std::uint64_t* out) const;

  [[noreturn]] void fail(const std::string& reason) const;

 private:
  void check_place(hid_t where) const;
  void inspect();
  void check_storage(std::size_t number_bytes) const;
  void check_packed_chunks(std::size_t number_bytes) const;
  void read_as(std::uint64_t first, std::uint64_t count, hid_t type, void* out) const;

  std::string file_;
  std::string path_;
  Hdf5Handle set_;
  std::uint64_t rows_ = 0;
  std::uint64_t components_ = 1;
  bool is_integer_ = false;
  bool is_signed_ = false;
};

/// Opens a file to read.  From then on the library loads no plugins and follows no link to another
/// file in this process, which is to be a child (read_hdf5_apart()).
/// ERRORS: mw::Error(kInput) when it is missing, damaged or no HDF5 file.
[[nodiscard]] Hdf5Handle open_hdf5(const std::string& file);

/// Runs read in a child, since damage makes the library crash, and passes on to sink what it
/// writes.  bytes is the size of all files that it reads, and bounds its time.
/// ERRORS: those of read and of sink; mw::Error(kInput) naming the file when the child died.
void read_hdf5_apart(const std::string& file, std::uint64_t bytes,
                     const std::function<void(MeshSink&)>& read, MeshSink& sink);

/// Writes the points of a range that stay, in batches; kept is null when all stay.
/// REQUIRES: 3 components.  ERRORS: mw::Error(kInput) when there are fewer, or one is not finite.
void stream_points(const Hdf5Array& points, RowRange range, const KeptRows* kept, MeshSink& sink);

/// Fills out, which has room for whole rows, with labels or other integers from row `first` on.
void read_labels(const Hdf5Array& labels, std::uint64_t first, std::vector<RawLabel>& out);

}  // namespace mw::io
