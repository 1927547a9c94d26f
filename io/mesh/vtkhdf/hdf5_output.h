// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes an HDF5 file, whole or not at all.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/file/sink/atomic_file.h"
#include "io/hdf5/hdf5_tree.h"
#include "io/mesh/columns.h"

namespace mw::io {

/// A file with the data first, each set in one piece, then what tells of them.  It is written
/// without the HDF5 library, which does not survive an allocation that fails; here that is
/// std::bad_alloc.  Equal content gives equal bytes.
/// ERRORS (all members): mw::Error(kResource) or kUsage as AtomicFile.  Thread safety: none.
class Hdf5Output {
 public:
  /// Makes the file, still without its name.
  explicit Hdf5Output(const std::filesystem::path& path) : name_(path.string()), file_(path) {}

  [[nodiscard]] const std::string& name() const { return name_; }

  /// Reserves room for a data set and returns the address of its first byte.
  [[nodiscard]] std::uint64_t reserve(std::uint64_t bytes) {
    return std::exchange(end_, end_ + (bytes + 7) / 8 * 8);
  }
  /// Returns where the next room will begin, for data whose size is not known yet.
  /// REQUIRES: that room is reserved once the data are written, and nothing else before it.
  [[nodiscard]] std::uint64_t next() const { return end_; }
  [[nodiscard]] AtomicFile& file() { return file_; }

  /// Writes the bytes of a data set, and returns the set with their address.
  [[nodiscard]] Hdf5DataSet add(Hdf5DataSet set, std::span<const std::byte> bytes) {
    set.address = reserve(bytes.size());
    file_.write_at(set.address, bytes);
    return set;
  }
  /// Writes a data set of kText.
  [[nodiscard]] Hdf5DataSet add_texts(const std::string& name, std::span<const std::string> texts) {
    const Hdf5Texts all = hdf5_texts(texts, next());
    file_.write_at(reserve(all.heap.size()), std::as_bytes(std::span(all.heap)));
    return add({.name = name, .kind = Hdf5Kind::kText, .shape = {texts.size()}},
               std::as_bytes(std::span(all.positions)));
  }

  /// Finishes the file and gives it its name.  REQUIRES: the data of all sets are written.
  void commit(const Hdf5Group& root) { finish(root).commit(); }
  /// Finishes the file without the commit, which may be one with other files (commit_together()).
  [[nodiscard]] AtomicFile& finish(const Hdf5Group& root) {
    const Hdf5Metadata metadata = hdf5_metadata(root, next());
    file_.write_at(next(), std::as_bytes(std::span(metadata.tail)));
    file_.write_at(0, std::as_bytes(std::span(metadata.head)));
    return file_;
  }

 private:
  std::string name_;
  AtomicFile file_;
  std::uint64_t end_ = kHdf5HeadBytes;  ///< end of what is reserved, a multiple of 8
};

/// Writes what is left in a column; returns its data set.  REQUIRES: shape is for all its numbers.
template <class T>
[[nodiscard]] Hdf5DataSet finish_column(FileColumn<T>& column, const std::string& name,
                                        Hdf5Kind kind, const std::vector<std::uint64_t>& shape) {
  column.flush();
  return {.name = name, .kind = kind, .shape = shape, .address = column.address()};
}

}  // namespace mw::io
