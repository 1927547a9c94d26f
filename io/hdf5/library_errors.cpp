// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Looks into the error stack of the HDF5 library.
#include "io/hdf5/library_errors.h"

#include <hdf5.h>

namespace mw::io {
namespace {

herr_t keep_first(unsigned, const H5E_error2_t* error, void* out) {
  auto& reason = *static_cast<std::string*>(out);
  if (reason.empty() && error->desc != nullptr) reason = error->desc;
  return 0;
}

}  // namespace

std::string hdf5_reason() {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, &keep_first, &reason);
  return reason.empty() ? "no reason given" : reason;
}

}  // namespace mw::io
