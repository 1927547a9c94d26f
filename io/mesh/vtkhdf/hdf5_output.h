// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// An HDF5 file that is written, whole or not at all.
#pragma once

#include <span>
#include <string>

#include "io/file/atomic_file.h"
#include "io/file/placed_output.h"
#include "io/hdf5/hdf5_tree.h"
#include "io/mesh/vtkhdf/hdf5_rooms.h"

namespace mw::io {

/// Data first, each in one piece, then what tells of them.  Without the HDF5 library, which does
/// not survive an allocation that fails: here that is std::bad_alloc.  Equal content is equal
/// bytes.
/// ERRORS (all members): mw::Error(kResource) or kUsage as AtomicFile.  Thread safety: none.
class Hdf5Output : public PlacedOutput {
 public:
  /// Makes the file, still without its name.
  explicit Hdf5Output(const std::filesystem::path& path) : name_(path.string()), file_(path) {}

  [[nodiscard]] const std::string& name() const { return name_; }

  [[nodiscard]] Hdf5Rooms& rooms() { return rooms_; }
  [[nodiscard]] std::uint64_t reserve(std::uint64_t bytes) { return rooms_.reserve(bytes); }
  void write_at(std::uint64_t address, std::span<const std::byte> bytes) override;
  /// The file gets the size of what is reserved.
  void extend() { file_.resize(rooms_.next()); }
  /// Where it is until the commit.
  [[nodiscard]] const std::filesystem::path& partial() const { return file_.partial(); }

  /// A data set of these bytes.
  [[nodiscard]] Hdf5DataSet add(Hdf5DataSet set, std::span<const std::byte> bytes);
  /// A data set of kText.
  [[nodiscard]] Hdf5DataSet add_texts(const std::string& name, std::span<const std::string> texts);

  /// REQUIRES: the data of all sets are written.
  void commit(const Hdf5Group& root) { finish(root).commit(); }
  /// The same up to the commit, which may be one with other files (commit_together.h).
  [[nodiscard]] AtomicFile& finish(const Hdf5Group& root);

 private:
  std::string name_;
  AtomicFile file_;
  Hdf5Rooms rooms_;
};

}  // namespace mw::io
