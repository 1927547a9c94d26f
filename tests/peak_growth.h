// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How much more memory an action needs.
#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <exception>

namespace mw::test {

inline long peak_kib() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return used.ru_maxrss;
}

/// Growth of the peak in a process of its own that does `action`, KiB; -1 when that threw or a
/// check in it failed.
template <class Action>
long growth_of(Action action) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return -1;
  const pid_t child = fork();
  if (child == 0) {
    const long before = peak_kib();
    long growth = -1;
    try {
      action();
      if (!::testing::Test::HasFailure()) growth = peak_kib() - before;
    } catch (const std::exception&) {
    }
    _exit(write(ends[1], &growth, sizeof growth) == sizeof growth ? 0 : 1);
  }
  long growth = -1;
  close(ends[1]);
  const bool told = read(ends[0], &growth, sizeof growth) == sizeof growth;
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return told ? growth : -1;
}

}  // namespace mw::test
