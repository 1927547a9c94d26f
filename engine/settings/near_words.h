// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a mistyped word was probably meant to be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mw::engine {

/// Returns words that differ from this one by at most a third of its letters or two, or of which
/// one begins with the other (3 letters or more), the nearest first.  Capitals do not count.
/// Cost: letters of all words times letters of this one.
[[nodiscard]] std::vector<std::string> near_words(std::string_view word,
                                                  const std::vector<std::string>& words);

/// Returns "; did you mean mesh?" about the nearest word, or nothing if none is near.
[[nodiscard]] std::string did_you_mean(std::string_view word,
                                       const std::vector<std::string>& words);

}  // namespace mw::engine
