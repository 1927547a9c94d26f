// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What is fuzzed: functions of bytes that must end well, or refuse their input, whatever the bytes.
#pragma once

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "kernels/core/error.h"

namespace mw::fuzz {

using Bytes = std::span<const std::byte>;

/// One of them.  run() throws when a property does not hold, or the code under test throws what it
/// does not promise; it may be called again and again.
struct Target {
  std::string_view name;  ///< also of its folder below seeds/
  void (*run)(Bytes bytes);
  int mutations = 2000;  ///< that the usual tests try; a second of them
};

/// All there are.
[[nodiscard]] std::span<const Target> targets();

/// A property that does not hold.
class Broken : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

inline void require(bool holds, const char* property) {
  if (!holds) throw Broken(property);
}

/// Runs the action; whether it came to its end.  An error about input or usage, with a message, is
/// the other way to end well; anything else passes through.
template <class Action>
bool ends_well(Action action) {
  try {
    action();
    return true;
  } catch (const Error& error) {
    const bool is_refusal = error.kind() == ErrorKind::kInput || error.kind() == ErrorKind::kUsage;
    if (!is_refusal) throw Broken(std::string("not refused as input: ") + error.what());
    require(std::string_view(error.what()).size() > 10, "a refusal says why");
    return false;
  }
}

[[nodiscard]] inline std::string_view text_of(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace mw::fuzz
