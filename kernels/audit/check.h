// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A named check with its verdict, and how an audit words its details.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace mw::audit {

/// One line of a report.  detail says what was counted, and names the first offenders if any.
struct Check {
  std::string name;
  bool passed = false;
  std::string detail;

  friend bool operator==(const Check&, const Check&) = default;
};

/// Counts offenders and remembers the first few by name.
class Offenders {
 public:
  /// noun is what text() calls the offenders, such as "tets".
  explicit Offenders(std::string_view noun) : noun_(noun) {}

  /// describe() -> std::string is called for the first few only.
  template <class Describe>
  requires std::is_invocable_v<Describe>
  void add(Describe&& describe) {
    if (count_++ < kNamed) first_.push_back(describe());
  }
  /// Adds the offenders that another one has counted, after its own.
  void add(const Offenders& others) {
    count_ += others.count_;
    for (const std::string& name : others.first_) {
      if (first_.size() < kNamed) first_.push_back(name);
    }
  }
  [[nodiscard]] std::uint64_t count() const { return count_; }
  /// "3 tets (5, 7, 9)"; "0 tets".
  [[nodiscard]] std::string text() const;

 private:
  static constexpr std::uint64_t kNamed = 4;

  std::string noun_;
  std::uint64_t count_ = 0;
  std::vector<std::string> first_;
};

/// A number as people read it, with four significant digits and, below 1e15, all that are before
/// the point: "0.5", "24312", "4.242e-07", "1e+36".  It does not depend on the locale.
[[nodiscard]] std::string number(double value);

}  // namespace mw::audit
