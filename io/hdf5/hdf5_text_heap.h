// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Strings of variable length in an HDF5 file that is written without the library.
#pragma once

#include <span>
#include <string>

namespace mw::io {

/// Global heap collections (HDF5 file format, III.E), and what a data set of Hdf5Kind::kText holds
/// of them: of each string its length, its collection and its place in there.
struct Hdf5Texts {
  std::string heap;       ///< for `address`
  std::string positions;  ///< the data set
};

/// address: a multiple of 8.
[[nodiscard]] Hdf5Texts hdf5_texts(std::span<const std::string> strings, std::uint64_t address);

}  // namespace mw::io
