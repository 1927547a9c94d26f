// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Elements by name.
#include "io/mesh/element.h"

#include <string>

#include "kernels/core/error.h"

namespace mw::io {

Element parse_element(std::string_view text) {
  if (text == "tet4") return Element::kTet4;
  if (text == "tet10") return Element::kTet10;
  throw Error(ErrorKind::kUsage,
              "'" + std::string(text) + "' is no element; those are tet4 and tet10");
}

}  // namespace mw::io
