// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Finds the worker program: beside the program, or where both were installed.
#pragma once

#include <filesystem>
#include <vector>

namespace mw::engine::codt {

/// The environment variable that names another worker program.
inline constexpr const char* kWorkerVariable = "MW_CODT_WORKER";

/// What may need a worker; a program that loads the library, as python3 does, has none beside it.
struct WorkerHost {
  std::filesystem::path program;  ///< the running program, absolute; empty if unknown
  std::filesystem::path
      object;  ///< program, library or module that this code is in, absolute; empty if unknown
};

/// Returns the host that this code runs in.
[[nodiscard]] WorkerHost this_host();

/// Returns where to look for mwmesh-codt, in this order: beside the program, beside the object, in
/// the folder for programs of the prefix that the object is installed in, even if that was moved,
/// and in that of the prefix that the build was configured for.  None is above a prefix.
[[nodiscard]] std::vector<std::filesystem::path> worker_paths(const WorkerHost& host);

/// Returns the worker program: that of kWorkerVariable, else the first of worker_paths(this_host())
/// that can be executed.  ERRORS: kUsage when there is none.
[[nodiscard]] std::filesystem::path find_worker();

}  // namespace mw::engine::codt
