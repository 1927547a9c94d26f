// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Errors become exit codes.
#include "engine/cli/exit_code.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string_view>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"

namespace mw::cli {
namespace {

std::atomic<bool> memory_was_out = false;
std::terminate_handler terminate_otherwise = nullptr;

/// Sets a flag and throws; some ways to std::terminate() have let go of the exception by then.
[[noreturn]] void note_and_throw() {
  memory_was_out = true;
  throw std::bad_alloc();
}

bool is_about_memory() {
  const std::exception_ptr thrown = std::current_exception();
  if (!thrown) return memory_was_out;
  try {
    std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    return true;
  } catch (...) {
    return false;
  }
}

[[noreturn]] void terminate() {
  if (is_about_memory()) {
    constexpr std::string_view kMessage =
        "mwmesh: error: out of memory; try a smaller volume or a larger machine\n";
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, kMessage.data(), kMessage.size());
    ::_exit(kExitResource);
  }
  terminate_otherwise();
  std::abort();
}

/// Returns a message with control characters as \xHH: a damaged file may have brought them in, and
/// a terminal would obey them.
std::string shown(std::string_view message) {
  std::string out;
  for (const char c : message) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_control = (byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7f;
    out += is_control ? io::printable({&c, 1}, 1) : std::string(1, c);
  }
  return out;
}

}  // namespace

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
  // This uses stdio, since it needs no memory when there is none left.
  const auto fail = [quiet](int code, const char* what, const char* message) {
    if (!quiet) std::fprintf(stderr, "mwmesh: error: %s%s\n", what, message);
    return code;
  };
  try {
    return action();
  } catch (const Error& error) {
    return fail(exit_code(error.kind()), "", shown(error.what()).c_str());
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
    const Error failure = io::file_failure(error);
    return fail(exit_code(failure.kind()), "", shown(failure.what()).c_str());
  } catch (const std::exception& error) {
    return fail(kExitInternal, "internal: ", error.what());
  } catch (...) {
    return fail(kExitInternal, "internal: ", "unknown exception");
  }
}

void end_well_without_memory() {
  std::set_new_handler(&note_and_throw);
  terminate_otherwise = std::set_terminate(&terminate);
}

}  // namespace mw::cli
