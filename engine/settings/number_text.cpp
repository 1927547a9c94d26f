// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers and labels of settings and options from text and back.
#include "engine/settings/number_text.h"

#include <cmath>

#include "io/file/errors.h"

namespace mw::engine {

void fail_expected(std::string_view expected, std::string_view text) {
  throw Error(ErrorKind::kUsage, io::text("expected ", expected, ", got '", text, "'"));
}

std::int64_t parse_integer(std::string_view text) {
  std::int64_t value = 0;
  if (!read_all(text, value)) fail_expected("an integer", text);
  return value;
}

double parse_number(std::string_view text) {
  double value = 0;
  if (!read_all(text, value) || !std::isfinite(value)) fail_expected("a finite number", text);
  return value;
}

RawLabel parse_label(std::string_view text) {
  RawLabel label = 0;
  if (read_all(text, label)) return label;
  std::int64_t negative = 0;
  if (!read_all(text, negative)) fail_expected("a label of at most 64 bits", text);
  return static_cast<RawLabel>(negative);
}

bool parse_switch(std::string_view text) {
  if (text == "true" || text == "1") return true;
  if (text == "false" || text == "0") return false;
  fail_expected("true or false", text);
}

std::string format_number(double value) {
  return io::text(value);
}

}  // namespace mw::engine
