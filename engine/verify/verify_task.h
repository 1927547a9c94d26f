// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What is asked of a mesh, and what may be spent on the answer.
#pragma once

#include <filesystem>
#include <functional>

#include "kernels/audit/audit.h"

namespace mw::engine {

struct VerifyTask {
  audit::AuditOptions options;
  int threads = 1;
  /// What tiles, sorts and buffers may take together.  More is taken where a tile with its
  /// interfaces needs more, and for parts of labels (verify_mesh()).
  std::uint64_t memory_bytes = std::uint64_t{256} << 20U;
  std::filesystem::path folder;           ///< of temporary files
  std::function<void()> between = [] {};  ///< called after each tile; may throw
};

}  // namespace mw::engine
