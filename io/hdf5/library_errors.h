// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the HDF5 library says is wrong.
#pragma once

#include <string>

namespace mw::io {

/// The innermost message of the call that failed last: "file signature not found".  Any other call
/// of the library forgets it.
[[nodiscard]] std::string hdf5_reason();

}  // namespace mw::io
