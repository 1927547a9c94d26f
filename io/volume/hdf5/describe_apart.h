// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the HDF5 library tells about a data set.  All of this may be called apart
// (io/file/wall/apart.h) only, as damage makes the library crash.
#pragma once

#include <hdf5.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/byte_order.h"
#include "io/hdf5/hdf5_file.h"
#include "io/volume/hdf5/description.h"
#include "io/volume/label_volume.h"

namespace mw::io {

struct Hdf5NumberType {
  VoxelType type = VoxelType::kU8;
  ByteOrder order = ByteOrder::kLittle;
};

/// Returns the type of integers of 8 to 64 bits, of enumerations of them (h5py's booleans), and of
/// floats of IEEE 754 in 32 or 64 bits; nothing for all others.
[[nodiscard]] std::optional<Hdf5NumberType> number_type(hid_t type);

/// Returns the filters that a list of properties names, in their order; nothing for damage.
[[nodiscard]] std::optional<std::vector<Hdf5Filter>> hdf5_filters(hid_t list);

/// Returns "u8", or what the type is instead, such as "compound".
[[nodiscard]] std::string type_text(hid_t type);

/// The most data sets that are looked at; a file of labels has a few.
inline constexpr std::size_t kMaxHdf5Entries = 4096;

/// Returns the first kMaxHdf5Entries data sets in and below a group ("/" or "/a/b"), by name, and
/// each once even if several hard links lead to it.  Soft and external links are not followed.
/// ERRORS: mw::Error(kInput) naming `file`.
[[nodiscard]] std::vector<Hdf5Entry> list_data_sets(hid_t hdf5, const std::string& group,
                                                    std::string_view file);

/// Describes a data set of the file `hdf5`, which was opened through source.
/// ERRORS: mw::Error(kInput) for damage, and for types and storage that cannot be read.
[[nodiscard]] Hdf5Description describe_data_set(Hdf5Source& source, hid_t hdf5,
                                                const std::string& path);

/// Finds where the data set `set` of the file `hdf5` lies: fills `numbers` and `axistags` of its
/// description.  The geometry is that of the nearest group above the data set which has one.  What
/// is there but holds no numbers is left out, and so is what links of the file lead to elsewhere.
/// ERRORS: mw::Error(kInput) naming file and what cannot be read, as a look-up that fails does not
/// say that there is nothing; also for more numbers than a place has.
void find_geometry(hid_t hdf5, hid_t set, std::string_view file, Hdf5Description& description);

}  // namespace mw::io
