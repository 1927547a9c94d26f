// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A data set that is written number by number.
#pragma once

#include <bit>
#include <vector>

#include "io/mesh/vtkhdf/hdf5_output.h"

namespace mw::io {

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
