// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What every mesh sink checks before a file gets its name.
#include "io/mesh/sink_counts.h"

#include "io/file/errors.h"

namespace mw::io {

void check_sink_counts(std::string_view file, const MeshHeader& header, std::uint64_t tets) {
  if (tets == header.tets) return;
  throw Error(ErrorKind::kInternal,
              text(file, ": ", tets, " tets were written, ", header.tets, " were announced"));
}

}  // namespace mw::io
