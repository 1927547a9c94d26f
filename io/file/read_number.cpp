// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "io/file/read_number.h"

#include <cerrno>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <string>

namespace mw::io {

bool read_real_by_c(std::string_view text, double& value) {
  // strtod() also takes blanks, '+' and hexadecimal digits.
  constexpr std::string_view kFirst = "-.0123456789inIN";
  const bool is_decimal = text.find_first_of(std::string_view("xX\0", 3)) == text.npos;
  if (text.empty() || kFirst.find(text.front()) == kFirst.npos || !is_decimal) return false;
  static const locale_t plain = ::newlocale(LC_ALL_MASK, "C", nullptr);
  const std::string whole(text);
  char* stop = nullptr;
  errno = 0;
  const double found = ::strtod_l(whole.c_str(), &stop, plain);
  if (stop != whole.c_str() + whole.size()) return false;
  const bool is_subnormal = found != 0.0 && std::isfinite(found);
  if (errno == ERANGE && !is_subnormal) return false;
  value = found;
  return true;
}

}  // namespace mw::io
