// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// MW_ASSERT: invariants, checked in debug, sanitizer and MW_CHECKED builds.
#pragma once

#include <cstdio>
#include <cstdlib>

#if !defined(NDEBUG) || defined(MW_CHECKED)
#define MW_ASSERT(condition)                                                                 \
  do {                                                                                       \
    if (!(condition)) {                                                                      \
      std::fprintf(stderr, "%s:%d: invariant broken: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                          \
    }                                                                                        \
  } while (false)
#else
#define MW_ASSERT(condition) static_cast<void>(0)
#endif
