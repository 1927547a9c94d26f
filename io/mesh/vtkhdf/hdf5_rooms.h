// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where the data sets of an HDF5 file lie.
#pragma once

#include <cstdint>
#include <utility>

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

}  // namespace mw::io
