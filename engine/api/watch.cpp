// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/api/watch.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <limits>

#include "engine/api/asked.h"
#include "engine/api/errors.h"

namespace mw::api {

Watch::Watch(const mw_hooks* hooks) {
  if (hooks == nullptr) return;
  std::memcpy(&hooks_, hooks, std::min(hooks->size, sizeof hooks_));
}

std::function<void()> Watch::stop() const {
  return [hooks = hooks_] {
    const bool is_set = hooks.stop != nullptr && __atomic_load_n(hooks.stop, __ATOMIC_RELAXED) != 0;
    if (!is_set && (hooks.cancel == nullptr || hooks.cancel(hooks.data) == 0)) return;
    throw Cancelled("the run was cancelled");
  };
}

std::function<void(const std::string&)> Watch::warn() const {
  return [hooks = hooks_](const std::string& line) {
    if (hooks.warn != nullptr) hooks.warn(hooks.data, in_words(line).c_str());
  };
}

std::function<void(const engine::RunProgress&)> Watch::progress() const {
  if (hooks_.progress == nullptr) return {};
  return [hooks = hooks_](const engine::RunProgress& at) {
    hooks.progress(hooks.data, at.done, at.total,
                   at.seconds_left.value_or(std::numeric_limits<double>::quiet_NaN()));
  };
}

}  // namespace mw::api
