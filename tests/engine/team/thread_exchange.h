// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Processes played by threads of one, with messages that take their time.
#pragma once

#include <chrono>
#include <memory>
#include <vector>

#include "engine/team/team.h"

namespace mw::engine {

struct ThreadExchangeOptions {
  int ranks = 1;
  std::uint32_t seed = 1;                  ///< of the delays
  std::chrono::microseconds max_delay{0};  ///< of a message; they overtake one another
};

/// Makes an exchange for each of the ranks; a thread of its own brings the messages of each.  For
/// tests of what does not depend on a network.
[[nodiscard]] std::vector<std::unique_ptr<Exchange>> thread_exchanges(
    const ThreadExchangeOptions& options);

}  // namespace mw::engine
