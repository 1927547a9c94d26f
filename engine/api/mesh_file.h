// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The file that a mesh of the library is written into.
#pragma once

#include <filesystem>
#include <memory>

#include "engine/request/mesh_request.h"
#include "io/mesh/mesh_sink.h"

namespace mw::api {

/// Opens a file with what the request says of it.  has_values tells whether it gets values of tets.
/// ERRORS: mw::Error(kUsage) for what its format has no place for, and for materials without values
/// where the format has a place for these.
[[nodiscard]] std::unique_ptr<io::MeshSink> open_file(const std::filesystem::path& path,
                                                      const request::MeshRequest& request,
                                                      bool has_values);

}  // namespace mw::api
