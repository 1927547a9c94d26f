// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// An HDF5 file that is written, whole or not at all, and its columns of numbers.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/file/sink/atomic_file.h"
#include "io/file/sink/partial_file.h"
#include "io/hdf5/hdf5_tree.h"

namespace mw::io {

/// Gives out the bytes of a file one behind the other: whoever asks for the same in the same order
/// gets the same addresses.
class Hdf5Rooms {
 public:
  /// Room for a data set: the address of its first byte.
  [[nodiscard]] std::uint64_t reserve(std::uint64_t bytes) {
    return std::exchange(end_, end_ + (bytes + 7) / 8 * 8);
  }
  /// Where the next room will begin: for data whose size is not known yet.
  /// REQUIRES: it is reserved when they are written, and nothing else before.
  [[nodiscard]] std::uint64_t next() const { return end_; }

 private:
  std::uint64_t end_ = kHdf5HeadBytes;  ///< of what is reserved; a multiple of 8
};

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
  void write_at(std::uint64_t address, std::span<const std::byte> bytes) override {
    file_.write_at(address, bytes);
  }
  /// The file gets the size of what is reserved.
  void extend() { file_.resize(rooms_.next()); }
  /// Where it is until the commit.
  [[nodiscard]] const std::filesystem::path& partial() const { return file_.partial(); }

  /// A data set of these bytes.
  [[nodiscard]] Hdf5DataSet add(Hdf5DataSet set, std::span<const std::byte> bytes) {
    set.address = reserve(bytes.size());
    write_at(set.address, bytes);
    return set;
  }
  /// A data set of kText.
  [[nodiscard]] Hdf5DataSet add_texts(const std::string& name, std::span<const std::string> texts) {
    const Hdf5Texts all = hdf5_texts(texts, rooms_.next());
    write_at(reserve(all.heap.size()), std::as_bytes(std::span(all.heap)));
    return add({.name = name, .kind = Hdf5Kind::kText, .shape = {texts.size()}},
               std::as_bytes(std::span(all.positions)));
  }

  /// REQUIRES: the data of all sets are written.
  void commit(const Hdf5Group& root) { finish(root).commit(); }
  /// The same up to the commit, which may be one with other files (commit_together.h).
  [[nodiscard]] AtomicFile& finish(const Hdf5Group& root) {
    const Hdf5Metadata metadata = hdf5_metadata(root, rooms_.next());
    write_at(rooms_.next(), std::as_bytes(std::span(metadata.tail)));
    write_at(0, std::as_bytes(std::span(metadata.head)));
    return file_;
  }

 private:
  std::string name_;
  AtomicFile file_;
  Hdf5Rooms rooms_;
};

/// Numbers one behind the other, from an address on.  T: as wide as the numbers in the file.
/// Cost: half a MiB.
template <class T>
class Hdf5Column {
 public:
  Hdf5Column() = default;
  /// address: reserved for as many bytes as will be added, or the next to be.
  /// REQUIRES: output outlives the column.
  Hdf5Column(PlacedOutput& output, std::uint64_t address) : output_(&output), address_(address) {
    buffer_.reserve(kBuffered);
  }
  /// ERRORS of all: as the output.
  void add(T value) {
    buffer_.push_back(value);
    if (buffer_.size() == kBuffered) flush();
  }
  /// The next to be added is that number of the column: what is between is another one's to write.
  void go_to(std::uint64_t number) {
    if (number == written_ + buffer_.size()) return;
    flush();
    written_ = number;
  }
  void flush() {
    if (buffer_.empty()) return;
    output_->write_at(address_ + written_ * sizeof(T), std::as_bytes(std::span(buffer_)));
    written_ += buffer_.size();
    buffer_.clear();
  }
  /// Writes what is left; a data set of this shape.  REQUIRES: it has as many numbers.
  [[nodiscard]] Hdf5DataSet finish(const std::string& name, Hdf5Kind kind,
                                   const std::vector<std::uint64_t>& shape) {
    flush();
    return {.name = name, .kind = kind, .shape = shape, .address = address_};
  }

 private:
  static_assert(std::endian::native == std::endian::little, "numbers are written as they are");
  static constexpr std::size_t kBuffered = (std::size_t{1} << 19) / sizeof(T);

  PlacedOutput* output_ = nullptr;
  std::uint64_t address_ = 0;
  std::uint64_t written_ = 0;  ///< numbers before those that are buffered
  std::vector<T> buffer_;
};

}  // namespace mw::io
