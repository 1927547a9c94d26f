// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Mistyped words: the distance against its definition, and what is suggested.
#include "engine/cli/nearest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace mw::cli {
namespace {

/// By trying every way, from the ends of both words.
std::size_t tried_distance(std::string_view a, std::string_view b) {
  if (a.empty() || b.empty()) return a.size() + b.size();
  const std::string_view c = a.substr(0, a.size() - 1), d = b.substr(0, b.size() - 1);
  std::size_t min = std::min({tried_distance(c, b) + 1, tried_distance(a, d) + 1,
                              tried_distance(c, d) + (a.back() == b.back() ? 0U : 1U)});
  if (!c.empty() && !d.empty() && a.back() == d.back() && c.back() == b.back()) {
    const std::size_t swapped =
        tried_distance(c.substr(0, c.size() - 1), d.substr(0, d.size() - 1)) + 1;
    min = std::min(min, swapped);
  }
  return min;
}

std::string random_word(std::mt19937& random, std::size_t longest) {
  std::string word(random() % (longest + 1), ' ');
  for (char& c : word) c = "abc"[random() % 3];
  return word;
}

TEST(EditDistance, IsThatOfEveryWayTried) {
  std::mt19937 random(371);
  for (int i = 0; i < 2000; ++i) {
    const std::string a = random_word(random, 5), b = random_word(random, 5);
    ASSERT_EQ(edit_distance(a, b), tried_distance(a, b)) << a << " " << b;
  }
}

TEST(EditDistance, TakesCapitalsForSmallLetters) {
  EXPECT_EQ(edit_distance("Window", "wINDOW"), 0U);
  EXPECT_EQ(edit_distance("WINDWO", "window"), 1U);
}

TEST(Nearest, FindsTheWordBehindOneMistake) {
  const std::vector<std::string> words{"window", "marches", "quality-floor", "edge-variance"};
  std::mt19937 random(372);
  for (int i = 0; i < 500; ++i) {
    const std::string& word = words[random() % words.size()];
    std::string typed = word;
    const std::size_t at = random() % (word.size() - 1);
    switch (random() % 4) {
      case 0:
        typed.erase(at, 1);
        break;
      case 1:
        typed.insert(at, "x");
        break;
      case 2:
        typed[at] = 'x';
        break;
      default:
        std::swap(typed[at], typed[at + 1]);
    }
    EXPECT_EQ(nearest(typed, words), word) << typed;
  }
}

TEST(Nearest, OfEqualsTheFirst) {
  EXPECT_EQ(nearest("abcd", {"abxx", "abce", "abcf"}), "abce");
  EXPECT_EQ(nearest("abcd", {"abcf", "abce"}), "abcf");
  EXPECT_EQ(nearest("max", {"max-volume", "max-distance"}), "max-volume");
}

TEST(Nearest, NothingWhereNothingIsNear) {
  EXPECT_EQ(nearest("foo", {"window", "report"}), std::nullopt);
  EXPECT_EQ(nearest("", {"a"}), std::nullopt);
  EXPECT_EQ(nearest("ab", {"ac"}), std::nullopt);
  EXPECT_EQ(nearest("word", {}), std::nullopt);
  EXPECT_EQ(nearest(std::string(1 << 20, 'a'), {"aaaa"}), std::nullopt);
}

TEST(DidYouMean, PutsThePrefixBefore) {
  EXPECT_EQ(did_you_mean("windwo", {"window"}, "--"), "; did you mean --window?");
  EXPECT_EQ(did_you_mean("foo", {"window"}, "--"), "");
}

}  // namespace
}  // namespace mw::cli
