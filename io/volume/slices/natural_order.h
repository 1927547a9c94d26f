// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The order of numbered names that people mean: slice2 before slice10.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mw::io {

/// Digits in a row count as one number; names that differ in leading zeros only are in the order of
/// their bytes.  A strict total order.
[[nodiscard]] bool comes_before(std::string_view a, std::string_view b);

/// A place where numbered names miss one: names a and b follow each other, but by another step than
/// the least between two others.
struct NumberGap {
  std::string a;
  std::string b;
};

/// REQUIRES: names in natural order.
/// ENSURES: empty when the names differ in more than one number or in other letters, so that
/// nothing can be said.
[[nodiscard]] std::optional<NumberGap> find_gap(const std::vector<std::string>& names);

}  // namespace mw::io
