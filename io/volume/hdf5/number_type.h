// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Types of HDF5 that are types of voxels.
#pragma once

#include <hdf5.h>

#include <optional>
#include <string>

#include "io/file/byte_order.h"
#include "io/volume/label_volume.h"

namespace mw::io {

struct Hdf5NumberType {
  VoxelType type = VoxelType::kU8;
  ByteOrder order = ByteOrder::kLittle;
};

/// Integers of 8 to 64 bits, enumerations of them (h5py's booleans), and floats of IEEE 754 in 32
/// or 64 bits; empty for all others.
[[nodiscard]] std::optional<Hdf5NumberType> number_type(hid_t type);

/// "u8", or what the type is instead: "compound".
[[nodiscard]] std::string type_text(hid_t type);

}  // namespace mw::io
