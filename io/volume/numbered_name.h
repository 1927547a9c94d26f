// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of files that headers make from a pattern and numbers.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace mw::io {

/// A name with one %d, as printf has it, which may have a width: "slice%03d.raw".
class NumberedName {
 public:
  /// ERRORS: mw::Error(kInput) naming the file and its field where there is no such pattern.
  NumberedName(std::string_view pattern, std::string_view file, std::string_view field);

  /// Returns the name with this number.  REQUIRES: it is not negative.
  [[nodiscard]] std::string with(std::int64_t number) const;

 private:
  std::string before_;
  std::size_t width_ = 0;
  bool has_zeros_ = false;
  std::string behind_;
};

}  // namespace mw::io
