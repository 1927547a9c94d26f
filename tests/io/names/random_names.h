// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of all kinds for the tests of what carries them.
#pragma once

#include "io/names/label_names.h"
#include "tests/testing.h"

namespace mw::io {

inline std::size_t below(std::mt19937& random, std::size_t count) {
  return random() % count;
}

/// What formats use for themselves, and letters of one to four bytes.
inline std::string random_name(std::mt19937& random) {
  constexpr const char* kPieces[] = {"a",
                                     "Z",
                                     "_",
                                     "-",
                                     "7",
                                     " ",
                                     "\"",
                                     "\\",
                                     "'",
                                     ",",
                                     ";",
                                     "#",
                                     "<",
                                     ">",
                                     "&",
                                     "]]>",
                                     "&amp;",
                                     "//",
                                     "é",
                                     "ß",
                                     "漢",
                                     "字",
                                     "\xF0\x9F\xA7\xA0",
                                     "<AppendedData encoding=\"raw\">",
                                     "%",
                                     "0",
                                     "End"};
  std::string name;
  for (std::size_t i = below(random, 12); i > 0; --i) {
    name += kPieces[below(random, std::size(kPieces))];
  }
  return clean_name(name);
}

inline std::optional<Colour> random_colour(std::mt19937& random) {
  if (below(random, 4) == 0) return std::nullopt;
  Colour colour{};
  for (std::uint8_t& part : colour) part = static_cast<std::uint8_t>(random());
  return colour;
}

/// Rows of different labels, ascending, each with a name of its own or a colour or both.
inline LabelNames random_names(std::mt19937& random, std::size_t count) {
  std::vector<LabelName> rows;
  for (std::size_t i = 0; i < count; ++i) {
    const RawLabel label = below(random, 3) == 0 ? RawLabel{random()} << 32U : below(random, 1000);
    const std::string name = random_name(random);
    const bool is_taken = std::any_of(rows.begin(), rows.end(),
                                      [&](const LabelName& row) { return row.name == name; });
    rows.push_back({label, is_taken ? "" : name, random_colour(random)});
  }
  return LabelNames(std::move(rows));
}

inline void expect_same_names(const LabelNames& a, const LabelNames& b) {
  ASSERT_EQ(a.rows().size(), b.rows().size());
  for (std::size_t i = 0; i < a.rows().size(); ++i) {
    EXPECT_EQ(a.rows()[i].label, b.rows()[i].label);
    EXPECT_EQ(a.rows()[i].name, b.rows()[i].name);
    EXPECT_EQ(a.rows()[i].colour, b.rows()[i].colour);
  }
}

}  // namespace mw::io
