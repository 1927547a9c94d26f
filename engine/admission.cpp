// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Asks the store, again after each visit that ends.
#include "engine/admission.h"

#include "engine/window_memory.h"

namespace mw::engine {

Admission Admitter::admit(Index3 window, bool first) {
  const auto token = std::make_shared<Index3>(window);
  std::unique_lock lock(mutex_);
  for (;;) {
    const std::uint64_t seen = ended_;
    if (store_.admit(window, window_bytes(grid_, window, store_))) {
      ++started_;
      return token;
    }
    if (!first) return nullptr;
    // All others have ended and there is still no room: one of them failed and keeps what it held.
    // Its error is on its way to the march, which will not look at what this window does.
    if (started_ == ended_) return nullptr;
    over_.wait(lock, [&] { return ended_ != seen; });
  }
}

void Admitter::ended() {
  {
    const std::lock_guard lock(mutex_);
    ++ended_;
  }
  over_.notify_all();
}

}  // namespace mw::engine
