// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers in words for people, and facts of a tree in lines.
#include "engine/report/figures.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "kernels/audit/check.h"

namespace mw::report {

std::string format_bytes(std::uint64_t bytes) {
  constexpr double kMiB = 1 << 20, kGiB = 1 << 30;
  const auto size = static_cast<double>(bytes);
  return size < kGiB ? format_fixed(size / kMiB, 1) + " MiB"
                     : format_fixed(size / kGiB, 1) + " GiB";
}

std::string format_fixed(double value, int digits) {
  std::array<char, 400> text{};  // the longest double has 309 digits before the point
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, digits)
          .ptr;
  const std::string out(text.data(), end);
  return out.find_first_not_of("-0.") == out.npos && out.starts_with('-') ? out.substr(1) : out;
}

std::string format_percent(double share, int digits) {
  return format_fixed(100 * share, digits) + " %";
}

std::string format_figure(double value) {
  return audit::number(value);
}

std::string format_volume(double volume, const std::string& unit) {
  constexpr double kCubicMillimetres = 1000;  // of a millilitre
  if (unit == "mm" && volume >= kCubicMillimetres) {
    return format_figure(volume / kCubicMillimetres) + " mL";
  }
  return format_figure(volume) + (unit.empty() ? "" : " " + unit + "3");
}

std::string with_commas(std::uint64_t number) {
  std::string out = std::to_string(number);
  for (std::size_t at = out.size(); at > 3; at -= 3) out.insert(at - 3, ",");
  return out;
}

std::string short_number(double value) {
  constexpr double kFewDigits = 1000, kMostDigits = 1e15;
  if (value < kFewDigits || value >= kMostDigits) return format_figure(value);
  return with_commas(static_cast<std::uint64_t>(std::llround(value)));
}

std::string joined(const std::vector<std::string>& words, std::string_view last) {
  std::string out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) out += i + 1 == words.size() ? last : ", ";
    out += words[i];
  }
  return out;
}

namespace {

/// Returns the fact of a name such as "output.tets"; null if it or what should hold it is null.
const io::Json& fact_at(std::string_view name, const io::Json& facts) {
  if (name.empty() || facts.is_null()) return facts;
  const std::size_t dot = std::min(name.find('.'), name.size());
  return fact_at(name.substr(std::min(dot + 1, name.size())), facts[name.substr(0, dot)]);
}

std::string text_of_fact(const io::Json& fact, std::string_view form) {
  if (fact.is_string()) return fact.text();
  if (fact.is_array()) {
    std::string out;
    for (const io::Json& element : fact.elements()) {
      out += (out.empty() ? "" : " x ") + text_of_fact(element, form);
    }
    return out;
  }
  if (form.empty()) return fact.dump();
  if (form == "g") return format_figure(fact.number());
  if (form == "n") return short_number(fact.number());
  if (form == ",") return with_commas(fact.integer());
  if (form == "b") return format_bytes(fact.integer());
  const int digits = form.front() - '0';
  return form.ends_with('%') ? format_percent(fact.number(), digits)
                             : format_fixed(fact.number(), digits);
}

}  // namespace

std::string told(std::string_view line, const io::Json& facts) {
  std::string out;
  for (std::size_t open = line.find('{'); open != line.npos; open = line.find('{')) {
    const std::size_t close = line.find('}', open);
    const std::string_view inside = line.substr(open + 1, close - open - 1);
    const std::size_t colon = std::min(inside.find(':'), inside.size());
    const io::Json& fact = fact_at(inside.substr(0, colon), facts);
    if (fact.is_null()) return "";
    out += line.substr(0, open);
    out += text_of_fact(fact, inside.substr(std::min(colon + 1, inside.size())));
    line.remove_prefix(close + 1);
  }
  return out.append(line);
}

}  // namespace mw::report
