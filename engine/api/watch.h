// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Hooks of a caller as the engine calls them.
#pragma once

#include <functional>
#include <string>

#include "engine/mwmesh_c.h"
#include "engine/run/run.h"

namespace mw::api {

/// The hooks of a call; those that it does not have do nothing.
class Watch {
 public:
  /// hooks may be null, and its functions outlive what is made here.
  explicit Watch(const mw_hooks* hooks);

  /// Returns a function that throws Cancelled once the caller asks for it.
  [[nodiscard]] std::function<void()> stop() const;
  [[nodiscard]] std::function<void(const std::string& line)> warn() const;
  /// Empty if nobody asks.
  [[nodiscard]] std::function<void(const engine::RunProgress&)> progress() const;

 private:
  mw_hooks hooks_{};
};

}  // namespace mw::api
