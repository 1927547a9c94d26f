// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The one place where errors become exit codes.
#include "engine/cli/exit_code.h"

#include <cstdio>
#include <filesystem>
#include <new>
#include <stdexcept>

#include "engine/cli/interrupt.h"

namespace mw::cli {
int exit_code(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::kInternal:
      return kExitInternal;
    case ErrorKind::kUsage:
      return kExitUsage;
    case ErrorKind::kInput:
      return kExitInput;
    case ErrorKind::kResource:
      return kExitResource;
    case ErrorKind::kCheckFailed:
      return kExitCheckFailed;
  }
  return kExitInternal;
}

int guarded(const std::function<int()>& action, bool quiet) noexcept {
  // stdio, since it needs no memory when there is none left.
  const auto fail = [quiet](int code, const char* what, const char* message) {
    if (!quiet) std::fprintf(stderr, "mwmesh: error: %s%s\n", what, message);
    return code;
  };
  try {
    return action();
  } catch (const Error& error) {
    return fail(exit_code(error.kind()), "", error.what());
  } catch (const Interrupted& interrupted) {
    if (interrupted.work.empty()) {
      return fail(kExitInterrupted, "", "interrupted; nothing was written");
    }
    return fail(kExitSaved, "interrupted; ", interrupted.work.c_str());
  } catch (const std::bad_alloc&) {
    return fail(kExitResource, "", "out of memory; try a smaller volume or a larger machine");
  } catch (const std::length_error& error) {
    return fail(kExitResource, "more data than memory can hold: ", error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(kExitResource, "check the disk: ", error.what());
  } catch (const std::exception& error) {
    return fail(kExitInternal, "internal: ", error.what());
  } catch (...) {
    return fail(kExitInternal, "internal: ", "unknown exception");
  }
}

}  // namespace mw::cli
