// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Text that may be damaged, fit for a terminal.
#include "io/file/printable.h"

namespace mw::io {

std::string printable(std::string_view text, std::size_t max) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string out;
  for (const char character : text.substr(0, max)) {
    const auto byte = static_cast<unsigned char>(character);
    if (byte >= 0x20 && byte < 0x7f) {
      out += character;
    } else {
      out.append("\\x").append({kDigits[byte >> 4U], kDigits[byte & 15U]});
    }
  }
  return text.size() > max ? out + "..." : out;
}

}  // namespace mw::io
