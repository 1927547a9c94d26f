// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Every target over its seeds, which hold what the fuzzers found, and over mutations of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "tests/fuzz/target.h"
#include "tests/temp_folder.h"

namespace mw::fuzz {
namespace {

struct Seed {
  std::string name;
  std::string content;
};

/// In the order of their names.
std::vector<Seed> seeds_of(std::string_view target) {
  const std::filesystem::path folder =
      std::filesystem::path(MW_SOURCE_DIR) / "tests" / "fuzz" / "seeds" / target;
  std::vector<Seed> out;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    out.push_back({entry.path().filename().string(), test::content_of(entry.path())});
  }
  std::ranges::sort(out, {}, &Seed::name);
  return out;
}

/// Changes bytes as a fuzzer does, without a look at what they do.
class Mutator {
 public:
  explicit Mutator(const std::vector<Seed>& seeds) : seeds_(seeds) {}

  /// A seed with one to four changes.
  std::string next() {
    std::string text = any_seed();
    for (std::size_t i = 1 + below(4); i > 0; --i) change(text);
    return text;
  }

 private:
  std::size_t below(std::size_t count) { return count == 0 ? 0 : random_() % count; }
  const std::string& any_seed() { return seeds_[below(seeds_.size())].content; }

  void change(std::string& text) {
    const std::size_t at = below(text.size()), length = 1 + below(8);
    switch (below(7)) {
      case 0:
        if (!text.empty()) text[at] = static_cast<char>(text[at] ^ 1 << below(8));
        break;
      case 1:
        text.replace(at, 1, 1, static_cast<char>(below(256)));
        break;
      case 2:
        text.replace(at, 1, 1, static_cast<char>('0' + below(10)));
        break;
      case 3:
        text.erase(at, length);
        break;
      case 4:
        text.insert(at, text.substr(below(text.size()), length));
        break;
      case 5:
        text.replace(at, length, length, below(2) == 0 ? '\xff' : '\0');
        break;
      default:
        splice(text, at);
    }
  }

  void splice(std::string& text, std::size_t at) {
    const std::string& other = any_seed();
    text = text.substr(0, at) + other.substr(std::min(at, other.size()));
  }

  const std::vector<Seed>& seeds_;
  std::mt19937 random_{1};
};

class FuzzSeeds : public testing::TestWithParam<Target> {
 protected:
  static std::string hex(const std::string& bytes) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string out;
    for (const char c : bytes) {
      out += kDigits[static_cast<unsigned char>(c) >> 4U];
      out += kDigits[static_cast<unsigned char>(c) & 15U];
    }
    return out;
  }
  /// The bytes in hexadecimal make a new seed: xxd -r -p.
  static void run(const std::string& what, const std::string& content) {
    try {
      GetParam().run(std::as_bytes(std::span(content)));
    } catch (const std::exception& error) {
      ADD_FAILURE() << what << ": " << error.what() << "\n" << hex(content);
    }
  }
};

TEST_P(FuzzSeeds, EndWell) {
  const std::vector<Seed> seeds = seeds_of(GetParam().name);
  ASSERT_FALSE(seeds.empty());
  for (const Seed& seed : seeds) run(seed.name, seed.content);
  run("nothing", "");
}

TEST_P(FuzzSeeds, MutatedEndWell) {
  const std::vector<Seed> seeds = seeds_of(GetParam().name);
  Mutator mutator(seeds);
  for (int i = 0; i < GetParam().mutations && !HasFailure(); ++i) {
    run("mutation " + std::to_string(i), mutator.next());
  }
}

INSTANTIATE_TEST_SUITE_P(All, FuzzSeeds, testing::ValuesIn(targets().begin(), targets().end()),
                         [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace mw::fuzz
