// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Errors of the engine as those of the library.
#pragma once

#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>

#include "engine/mwmesh.h"
#include "io/file/errors.h"
#include "kernels/core/error.h"

namespace mw::api {

/// Returns the message in words for a caller of functions: "--max-distance" becomes "max_distance",
/// and "--from" becomes "from_kept".  Flags that the library has nothing for stay as they are: they
/// belong to commands.
[[nodiscard]] std::string library_words(std::string message);

[[nodiscard]] mwmesh::Error library_error(const Error& error);

/// Returns the path.  ERRORS: mw::Error(kUsage) for one with a zero byte, where the system ends it.
[[nodiscard]] const std::filesystem::path& checked_path(const std::filesystem::path& path,
                                                        const char* name = "path");

/// Calls work(), which settles one option; its errors name that option.
template <class Work>
auto naming(const char* option, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    throw Error(error.kind(), std::string(option) + ": " + error.what());
  }
}

/// Calls work(); its errors become mwmesh::Error.
template <class Work>
auto guarded(const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    throw library_error(error);
  } catch (const std::filesystem::filesystem_error& failure) {
    throw library_error(io::file_failure(failure));
  } catch (const std::length_error&) {
    throw mwmesh::Error(mwmesh::ErrorKind::kResource,
                        "this is more than memory can hold: give a smaller volume");
  } catch (const std::bad_alloc&) {
    throw mwmesh::Error(mwmesh::ErrorKind::kResource,
                        "memory is out: give a smaller budget or a smaller volume, or free some");
  }
}

}  // namespace mw::api
