// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Handlers of operator new and of std::terminate.
#include "engine/cli/out_of_memory.h"

#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include "engine/cli/exit_code.h"

namespace mw::cli {
namespace {

std::atomic<bool> memory_was_out = false;
std::terminate_handler terminate_otherwise = nullptr;

/// Some ways to std::terminate() have let go of the exception: the flag tells.
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

}  // namespace

void end_well_without_memory() {
  std::set_new_handler(&note_and_throw);
  terminate_otherwise = std::set_terminate(&terminate);
}

}  // namespace mw::cli
