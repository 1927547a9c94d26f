// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Finds the labels in an HDF5 file, by the HDF5 library in a process of its own.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/source/byte_source.h"
#include "io/volume/hdf5/description.h"

namespace mw::io {

struct Hdf5Entry {
  std::string path;  ///< from the root, with the slash
  std::vector<std::uint64_t> shape;
  std::string type;  ///< "u8", or what it is instead
  bool is_integer = false;
};

/// Data sets that are looked at; a file of labels has a few.
inline constexpr std::size_t kMaxHdf5Entries = 4096;

/// The first kMaxHdf5Entries data sets in and below a group, by name; each once, whatever hard
/// links lead to it; soft and external links are not followed.  group: "/" or "/a/b".
/// ERRORS: mw::Error(kInput) naming `file`.  To be called apart (io/file/wall/apart.h) only.
[[nodiscard]] std::vector<Hdf5Entry> list_data_sets(hid_t hdf5, const std::string& group,
                                                    std::string_view file);

/// The labels by convention: CREMI's /volumes/labels/neuron_ids, else the only integers below
/// /volumes/labels; ilastik's /exported_data; the only FeatureIds of DREAM.3D; else the only
/// integers with three axes longer than 1, else with two.
/// ERRORS: mw::Error(kInput) naming `file` and the data sets that there are, when none or several
/// are fit.
[[nodiscard]] const std::string& choose_data_set(const std::vector<Hdf5Entry>& entries,
                                                 std::string_view file);

/// "/a 3 x 4 x 5 u8, /b 7 f64"; the first few.
[[nodiscard]] std::string list_text(const std::vector<Hdf5Entry>& entries);

/// "3 x 4 x 5"
[[nodiscard]] std::string shape_text(const std::vector<std::uint64_t>& shape);

/// data_set: "/a/b" of the labels or of a group that has them; empty: by convention, see
/// choose_data_set().  The library never sees the file in this process: damage makes it crash.
/// ENSURES: what is described is within the file and fits together, see check_description().
/// Memory: 24 bytes a chunk that the file has; time: some microseconds a chunk of the grid.
/// ERRORS: mw::Error(kInput) for damage, for a data set that is missing, none or one of several
/// that are fit, and for types and storage that cannot be read; kResource when no process can be
/// started.
[[nodiscard]] Hdf5Description describe_hdf5(const ByteSource& source, const std::string& data_set);

/// ERRORS: mw::Error(kInput) unless shapes have as many axes as each other, chunks are within the
/// file, in order and no more than it, and runs of bytes have the size that the shape needs.
void check_description(const ByteSource& source, const Hdf5Description& description);

}  // namespace mw::io
