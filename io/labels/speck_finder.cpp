// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Union-find over the runs of two planes; a component that no later plane can reach is finished.
#include <algorithm>
#include <deque>
#include <limits>
#include <tuple>

#include "io/file/text_numbers.h"
#include "io/labels/label_runs.h"
#include "io/labels/specks.h"

namespace mw::io {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint64_t kMaxRuns = std::uint64_t{1} << 31;

/// Runs in lists; to join or free lists takes a time that does not depend on their length.
class RunLists {
 public:
  struct List {
    std::uint32_t first = kNone;
    std::uint32_t last = kNone;
  };

  void add(List& list, const SpeckRun& run) {
    std::uint32_t at = free_;
    if (at == kNone) {
      at = static_cast<std::uint32_t>(nodes_.size());
      nodes_.push_back({run, kNone});
    } else {
      free_ = nodes_[at].next;
      nodes_[at] = {run, kNone};
    }
    append(list, {at, at});
  }
  void append(List& list, const List& more) {
    if (more.first == kNone) return;
    if (list.first == kNone) {
      list = more;
      return;
    }
    nodes_[list.last].next = more.first;
    list.last = more.last;
  }
  void free(List& list) {
    if (list.first == kNone) return;
    nodes_[list.last].next = free_;
    free_ = list.first;
    list = {};
  }
  template <class Visit>
  void visit(const List& list, Visit visit) const {
    for (std::uint32_t at = list.first; at != kNone; at = nodes_[at].next) visit(nodes_[at].run);
  }
  void clear() {
    nodes_.clear();
    free_ = kNone;
  }

 private:
  struct Node {
    SpeckRun run;
    std::uint32_t next = kNone;
  };
  std::deque<Node> nodes_;
  std::uint32_t free_ = kNone;
};

/// A component as far as it has been read; only those of the last two planes are held.
struct Part {
  std::uint32_t parent = 0;
  std::uint32_t met = kNone;   ///< the part whose contact was counted last
  RunLists::List list;         ///< empty when it is no speck
  std::uint64_t voxels = 0;    ///< counted up to rule.min
  std::uint64_t runs = 0;      ///< 0 when it is no speck; the list has them if it is stored
  std::uint64_t contacts = 0;  ///< 0 when it is no speck; some may be counted twice
  RawLabel label = 0;
};

/// Returns an amount of memory, in the unit of --memory where that sets the limits.
std::string amount(std::uint64_t bytes, const SpeckLimits& limits) {
  return limits.is_of_budget ? size_words(bytes) : text(bytes, " bytes");
}

class Finder {
 public:
  Finder(const SpeckRule& rule, const SpeckLimits& limits)
      : rule_(rule),
        limits_(limits),
        max_runs_(std::min(limits.memory / kBytesPerSpeckRun, kMaxRuns)),
        reach_(rule.diagonal ? 1 : 0) {}

  void read_row(RunPlanes& planes, std::int64_t y, std::int64_t z) {
    for (LabelRun& run : planes.current.row(y)) {
      run.part = kNone;
      met_.clear();
      if (&run != planes.current.row(y).data()) met_.push_back((&run - 1)->part);
      join_row(planes.current.row(y - 1), run, reach_);
      if (rule_.diagonal) join_row(planes.below.row(y - 1), run, 1);
      join_row(planes.below.row(y), run, reach_);
      if (rule_.diagonal) join_row(planes.below.row(y + 1), run, 1);
      if (run.part == kNone) run.part = new_part(run.label);
      const std::uint32_t root = find(run.part);
      add_run(parts_[root], run, y, z);
      for (const std::uint32_t other : met_) meet(root, find(other));
    }
  }

  /// Parts that do not reach this plane are finished; the others get new numbers.
  void read_plane(RunPlanes& planes) {
    check_plane(planes);
    kept_.clear();
    renamed_.assign(parts_.size(), kNone);
    for (LabelRun& run : planes.current.all()) {
      const std::uint32_t root = find(run.part);
      if (renamed_[root] == kNone) {
        renamed_[root] = static_cast<std::uint32_t>(kept_.size());
        kept_.push_back(parts_[root]);
        kept_.back().parent = renamed_[root];
      }
      run.part = renamed_[root];
    }
    for (std::uint32_t i = 0; i < parts_.size(); ++i) {
      if (parts_[i].parent == i && renamed_[i] == kNone) finish(parts_[i]);
    }
    for (Part& part : kept_) {
      if (part.met != kNone) part.met = renamed_[find(part.met)];
    }
    parts_.swap(kept_);
  }

  Specks take() {
    for (std::uint32_t i = 0; i < parts_.size(); ++i) {
      if (parts_[i].parent == i) finish(parts_[i]);
    }
    if (!stores_) fail_too_many_specks(rule_, memory_.specks, limits_, memory_.enough());
    lists_.clear();
    std::sort(found_.runs.begin(), found_.runs.end(), [](const SpeckRun& a, const SpeckRun& b) {
      return std::tie(a.z, a.y, a.begin) < std::tie(b.z, b.y, b.begin);
    });
    found_.memory = memory_.enough();
    return std::move(found_);
  }

 private:
  std::uint32_t find(std::uint32_t part) {
    while (parts_[part].parent != part) {
      parts_[part].parent = parts_[parts_[part].parent].parent;
      part = parts_[part].parent;
    }
    return part;
  }

  std::uint32_t new_part(RawLabel label) {
    const auto id = static_cast<std::uint32_t>(parts_.size());
    parts_.push_back({.parent = id, .label = label});
    return id;
  }

  void join_row(std::span<LabelRun> row, LabelRun& run, std::int32_t reach) {
    for_each_touching(row, run, reach, [&](const LabelRun& other) {
      if (other.label != run.label) return met_.push_back(other.part);
      const std::uint32_t root = find(other.part);
      run.part = run.part == kNone ? root : unite(find(run.part), root);
    });
  }

  [[nodiscard]] bool is_small(const Part& part) const { return part.voxels < rule_.min; }

  /// Joins two parts and returns their root.  REQUIRES: a and b are roots.
  std::uint32_t unite(std::uint32_t a, std::uint32_t b) {
    if (a == b) return a;
    if (b < a) std::swap(a, b);
    Part &to = parts_[a], &from = parts_[b];
    from.parent = a;
    to.voxels = std::min(to.voxels + from.voxels, rule_.min);
    to.runs += from.runs;
    to.contacts += from.contacts;
    lists_.append(to.list, from.list);
    if (!is_small(to)) forget(to);
    return a;
  }

  void add_run(Part& part, const LabelRun& run, std::int64_t y, std::int64_t z) {
    if (!is_small(part)) return;
    part.voxels += std::min(static_cast<std::uint64_t>(run.end - run.begin), rule_.min);
    ++part.runs;
    if (stores_) {
      lists_.add(part.list, {run.begin, run.end, static_cast<std::int32_t>(y),
                             static_cast<std::int32_t>(z), 0});
    }
    memory_.add_run();
    if (memory_.runs > max_runs_) stop_storing();
    if (!is_small(part)) forget(part);
  }

  /// Counts a contact of two parts, but not when it repeats the last one, as most repetitions do.
  void meet(std::uint32_t a, std::uint32_t b) {
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
      Part& part = parts_[from];
      if (!is_small(part) || part.met == to) continue;
      part.met = to;
      ++part.contacts;
    }
  }

  /// Frees the runs of a part that is no speck.
  void forget(Part& part) {
    memory_.runs -= part.runs;
    ++memory_.large;
    lists_.free(part.list);
    part.runs = part.contacts = 0;
  }

  /// Frees all runs; from here on specks are only counted, so that the error can tell their number.
  void stop_storing() {
    if (!stores_) return;
    stores_ = false;
    lists_.clear();
    found_ = {};
    for (Part& part : parts_) part.list = {};
  }

  void finish(Part& part) {
    if (!is_small(part)) return;
    const auto id = static_cast<std::uint32_t>(memory_.specks++);
    memory_.contacts += part.contacts;
    if (!stores_) return;
    lists_.visit(part.list, [&](SpeckRun run) {
      run.speck = id;
      found_.runs.push_back(run);
    });
    lists_.free(part.list);
    found_.labels.push_back(part.label);
  }

  void check_plane(const RunPlanes& planes) {
    const std::uint64_t bytes =
        planes.bytes() + (parts_.capacity() + kept_.capacity()) * sizeof(Part);
    memory_.planes = std::max(memory_.planes, bytes);
    if (bytes <= limits_.memory) return;
    std::string way_out = "merge labels";
    if (limits_.is_of_budget) {
      way_out = "that takes --memory " + mebibytes(SpeckLimits::kShare * bytes) + " at least";
    }
    throw Error(ErrorKind::kResource,
                text("--drop-specks: two slices of the volume have more runs of labels than fit: "
                     "they take ",
                     amount(bytes, limits_), ", more than ", amount(limits_.memory, limits_), "; ",
                     way_out));
  }

  SpeckRule rule_;
  SpeckLimits limits_;
  std::uint64_t max_runs_;
  std::int32_t reach_;
  std::vector<Part> parts_;
  std::vector<Part> kept_;              ///< scratch of read_plane()
  std::vector<std::uint32_t> renamed_;  ///< scratch of read_plane()
  RunLists lists_;
  Specks found_;
  SpeckMemory memory_;
  std::vector<std::uint32_t> met_;  ///< scratch of read_row(): parts that the run touches
  bool stores_ = true;
};

}  // namespace

Specks find_specks(const LabelVolume& volume, const SpeckRule& rule, const SpeckLimits& limits) {
  Finder finder(rule, limits);
  sweep_runs(
      volume, limits.slab_voxels,
      [&](RunPlanes& planes, std::int64_t y, std::int64_t z) { finder.read_row(planes, y, z); },
      [&](RunPlanes& planes, std::int64_t) { finder.read_plane(planes); });
  return finder.take();
}

void fail_too_many_specks(const SpeckRule& rule, std::uint64_t specks, const SpeckLimits& limits,
                          std::uint64_t enough) {
  std::string message = text(
      "--drop-specks ", rule.min, ": ", specks, " components are smaller, and do not fit into ",
      amount(limits.memory, limits), "; they take ", amount(enough, limits), "; ");
  if (limits.is_of_budget) {
    message += text("--memory ", mebibytes(SpeckLimits::kShare * enough),
                    " is enough, a quarter of which is theirs; or ");
  }
  throw Error(ErrorKind::kResource, message + "drop smaller ones only");
}

}  // namespace mw::io
