// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The data sets of an HDF5 file, and which of them holds the labels.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

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
/// ERRORS: mw::Error(kInput) naming `file`.  To be called apart (io/file/apart.h) only.
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

}  // namespace mw::io
