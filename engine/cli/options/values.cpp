// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Values of options from text and back.
#include "engine/cli/options/values.h"

#include <algorithm>

#include "kernels/core/error.h"

namespace mw::cli {
namespace {

using engine::fail_expected;
using engine::read_all;

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t comma = text.find(','); comma != text.npos; comma = text.find(',')) {
    parts.push_back(text.substr(0, comma));
    text.remove_prefix(comma + 1);
  }
  parts.push_back(text);
  return parts;
}

}  // namespace

std::array<double, 3> parse_numbers(std::string_view text) {
  const std::vector<std::string_view> parts = split(text);
  if (parts.size() != 1 && parts.size() != 3) fail_expected("three numbers X,Y,Z, or one", text);
  std::array<double, 3> out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = parse_number(parts[i % parts.size()]);
  return out;
}

Index3 parse_shape(std::string_view text) {
  const std::vector<std::string_view> parts = split(text);
  std::array<std::int64_t, 3> out{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (parts.size() != 3 || !read_all(parts[i], out[i]) || out[i] < 1) {
      fail_expected("three positive integers X,Y,Z", text);
    }
  }
  return {out[0], out[1], out[2]};
}

Box3 parse_box(std::string_view text) {
  const std::vector<std::string_view> parts = split(text);
  std::array<std::int64_t, 6> out{};
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (parts.size() != out.size() || !read_all(parts[i], out[i])) {
      fail_expected("six integers X0,Y0,Z0,X1,Y1,Z1", text);
    }
  }
  return {{out[0], out[1], out[2]}, {out[3], out[4], out[5]}};
}

std::vector<RawLabel> parse_labels(std::string_view text) {
  std::vector<RawLabel> labels;
  for (const std::string_view part : split(text)) labels.push_back(parse_label(part));
  return labels;
}

}  // namespace mw::cli
