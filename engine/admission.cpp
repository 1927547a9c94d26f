// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Asks the store, again after each visit that ends.
#include "engine/admission.h"

namespace mw::engine {

Admission Admitter::admit(Index3 window, bool first) {
  const auto token = std::make_shared<Index3>(window);
  std::unique_lock lock(mutex_);
  for (;;) {
    const std::uint64_t seen = ended_;
    if (store_.admit(window, bytes_(window))) {
      ++in_flight_;
      return token;
    }
    if (!first) return nullptr;
    if (in_flight_ == 0) {
      // There is still no room: a window that failed keeps what it held.  Its error is on its way
      // to the march; this window starts all the same, and visit() lets it pass.
      ++in_flight_;
      return nullptr;
    }
    over_.wait(lock, [&] { return ended_ != seen; });
  }
}

void Admitter::visit(Index3 window, const VisitWindow& work) {
  if (failed_) return end(false);
  try {
    work(window);
  } catch (...) {
    end(true);
    throw;
  }
  end(false);
}

void Admitter::end(bool failed) {
  {
    const std::lock_guard lock(mutex_);
    if (failed) failed_ = true;
    --in_flight_;
    ++ended_;
  }
  over_.notify_all();
}

}  // namespace mw::engine
