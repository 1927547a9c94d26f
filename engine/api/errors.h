// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Exceptions of the engine as errors of mwmesh_c.h.
#pragma once

#include <exception>

#include "engine/api/handles.h"

namespace mw::api {

/// A run that mw_hooks ended.
class Cancelled : public std::exception {
 public:
  explicit Cancelled(std::string text) : text_(std::move(text)) {}
  [[nodiscard]] const char* what() const noexcept override { return text_.c_str(); }

 private:
  std::string text_;
};

/// A function of the caller's that returned that it failed.
class CallbackFailed : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override {
    return "volume: the function that reads its voxels failed";
  }
};

/// Puts the exception that is being handled into *error, unless error is null.  Returns its kind.
mw_status keep_error(mw_error** error) noexcept;

/// Calls work().  Returns MW_OK, or the kind of what it threw.
template <class Work>
mw_status tried(mw_error** error, const Work& work) noexcept {
  try {
    work();
    return MW_OK;
  } catch (...) {
    return keep_error(error);
  }
}

/// Returns what work() returns, which is a pointer; null where it throws.
template <class Work>
auto made(mw_error** error, const Work& work) noexcept -> decltype(work()) {
  try {
    return work();
  } catch (...) {
    keep_error(error);
    return nullptr;
  }
}

/// Returns a copy that mw_free() frees.
[[nodiscard]] char* text_of(const std::string& bytes);

/// ERRORS: mw::Error(kUsage) for null, naming what is missing.
void require(const void* argument, const char* name);

}  // namespace mw::api
