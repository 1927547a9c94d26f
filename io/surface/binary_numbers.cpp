// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What formats with numbers of 32 bits can hold.
#include "io/surface/binary_numbers.h"

#include "io/file/errors.h"

namespace mw::io {

void check_max(std::string_view file, std::string_view what, std::uint64_t count,
               std::uint64_t max) {
  if (count <= max) return;
  throw Error(ErrorKind::kUsage, text(file, ": ", count, " ", what, " are more than the ", max,
                                      " that this format can hold; write each label apart"));
}

}  // namespace mw::io
