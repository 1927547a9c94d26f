// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which word was meant by a mistyped one.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mw::cli {

/// Letters to insert, leave out, replace or swap with the next one (each letter in one edit at
/// most), whatever their case.  Cost: O(a.size() * b.size()).
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The word with the fewest edits, no more than a third of the longer one's letters (and one where
/// that is less); else the first that begins with `word`; of equals the first in the list.  A word
/// of fewer than three letters is near to none.
[[nodiscard]] std::optional<std::string> nearest(std::string_view word,
                                                 const std::vector<std::string>& words);

/// "; did you mean PREFIXnearest?", or nothing.
[[nodiscard]] std::string did_you_mean(std::string_view word, const std::vector<std::string>& words,
                                       const std::string& prefix = {});

}  // namespace mw::cli
