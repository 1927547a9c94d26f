// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What tests cannot expect of an instrumented program.
#pragma once

namespace mw::test {

/// False under sanitizers, which keep what is freed and shadow what is not: resident memory is then
/// no longer the program's.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kResidentMemoryIsOurs = false;
#else
inline constexpr bool kResidentMemoryIsOurs = true;
#endif

/// False under sanitizers, which open pipes to look at memory.
inline constexpr bool kOpenFilesAreOurs = kResidentMemoryIsOurs;

}  // namespace mw::test
