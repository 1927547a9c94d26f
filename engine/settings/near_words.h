// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a mistyped word was probably meant to be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mw::engine {

/// Those of the words that differ from this one by a third of its letters at most, or that one of
/// the two begins with, the nearest first; capitals do not count.
/// Cost: letters of all words times letters of this one.
[[nodiscard]] std::vector<std::string> near_words(std::string_view word,
                                                  const std::vector<std::string>& words);

/// "; did you mean mesh?" of the nearest; empty: none is near.
[[nodiscard]] std::string did_you_mean(std::string_view word,
                                       const std::vector<std::string>& words);

}  // namespace mw::engine
