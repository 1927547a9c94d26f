// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Components of the part graph without each class in turn, for all classes at once.
#include <algorithm>
#include <numeric>
#include <utility>

#include "kernels/audit/part_graph.h"

namespace mw::audit {
namespace {

/// Union by size without path compression, so that the last unions can be taken back.
class UndoableSets {
 public:
  explicit UndoableSets(std::size_t count) : parent_(count), size_(count, 1) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }

  void unite(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    if (size_[a] < size_[b]) std::swap(a, b);
    parent_[b] = a;
    size_[a] += size_[b];
    joined_.push_back(b);
  }

  [[nodiscard]] std::size_t unions() const { return joined_.size(); }

  void undo_to(std::size_t unions) {
    for (; joined_.size() > unions; joined_.pop_back()) {
      const std::uint32_t child = joined_.back();
      size_[parent_[child]] -= size_[child];
      parent_[child] = child;
    }
  }

 private:
  [[nodiscard]] std::uint32_t root(std::uint32_t member) const {
    while (parent_[member] != member) member = parent_[member];
    return member;
  }

  std::vector<std::uint32_t> parent_;
  std::vector<std::uint32_t> size_;
  std::vector<std::uint32_t> joined_;
};

class ComplementCounter {
 public:
  ComplementCounter(std::span<const Label> part_class, std::size_t class_count)
      : part_class_(part_class), sets_(part_class.size()), parts_of_(class_count, 0) {
    for (const Label c : part_class) ++parts_of_[c];
    count_.resize(class_count);
  }

  /// Fills count_ for classes lo .. hi-1.  INVARIANT: `touching` are the pairs with a part of
  /// these classes; all other pairs are united already.
  void solve(std::size_t lo, std::size_t hi, const std::vector<PartPair>& touching) {
    if (hi - lo == 1) {
      const std::size_t rest = part_class_.size() - static_cast<std::size_t>(parts_of_[lo]);
      count_[lo] = static_cast<std::int64_t>(rest - sets_.unions());
      return;
    }
    const std::size_t mid = lo + (hi - lo) / 2;
    descend(lo, mid, touching);
    descend(mid, hi, touching);
  }

  [[nodiscard]] std::vector<std::int64_t> take() { return std::move(count_); }

 private:
  void descend(std::size_t lo, std::size_t hi, const std::vector<PartPair>& pairs) {
    const std::size_t mark = sets_.unions();
    std::vector<PartPair> touching;
    const auto inside = [&](std::uint32_t part) {
      return part_class_[part] >= lo && part_class_[part] < hi;
    };
    for (const PartPair& pair : pairs) {
      if (inside(pair.a) || inside(pair.b)) {
        touching.push_back(pair);
      } else {
        sets_.unite(pair.a, pair.b);
      }
    }
    solve(lo, hi, touching);
    sets_.undo_to(mark);
  }

  std::span<const Label> part_class_;
  UndoableSets sets_;
  std::vector<std::int64_t> parts_of_;
  std::vector<std::int64_t> count_;
};

}  // namespace

std::vector<std::int64_t> components_without(std::span<const Label> part_class,
                                             std::vector<PartPair> pairs, std::size_t class_count) {
  ComplementCounter counter(part_class, class_count);
  if (class_count > 0) counter.solve(0, class_count, pairs);
  return counter.take();
}

}  // namespace mw::audit
