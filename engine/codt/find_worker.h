// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where the worker program is: beside the program, or where both were installed.
#pragma once

#include <filesystem>
#include <vector>

namespace mw::engine::codt {

/// Names another worker program.
inline constexpr const char* kWorkerVariable = "MW_CODT_WORKER";

/// Who may need a worker; a program that loads the library, as python3 does, has none beside it.
struct WorkerHost {
  std::filesystem::path program;  ///< the running one, absolute; empty: unknown
  std::filesystem::path
      object;  ///< program, library or module that this code is in, absolute; empty: unknown
};

/// The host that this is.
[[nodiscard]] WorkerHost this_host();

/// Where mwmesh-codt is looked for, in this order: beside the program, beside the object, in the
/// folder for programs of the prefix that the object is installed in, wherever that has been moved
/// to, and in that of the prefix that the build was configured for.  Nowhere above a prefix.
[[nodiscard]] std::vector<std::filesystem::path> worker_paths(const WorkerHost& host);

/// The worker program: that of kWorkerVariable, else the first of worker_paths(this_host()).
/// ERRORS: kUsage when it is not there or cannot be executed.
[[nodiscard]] std::filesystem::path find_worker();

}  // namespace mw::engine::codt
