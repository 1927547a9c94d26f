// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads the runs of the volume again, and knows those of specks by their place.
#include "io/labels/specks.h"

#include <algorithm>
#include <tuple>
#include <unordered_map>

#include "io/labels/label_runs.h"
#include "io/labels/label_table.h"

namespace mw::io {
namespace {

constexpr std::uint32_t kNoSpeck = 0xffffffffU;

/// A list of contacts, which adds up equal ones, as they come again and again.
class ContactList {
 public:
  explicit ContactList(std::size_t max) : max_(max) {}

  /// False when there are too many.
  [[nodiscard]] bool add(const SpeckContact& contact) {
    if (list_.size() >= std::min(limit_, max_)) {
      sum_up();
      if (list_.size() > contacts_that_fit(max_)) return false;
    }
    list_.push_back(contact);
    return true;
  }
  [[nodiscard]] std::vector<SpeckContact> take() {
    sum_up();
    list_.shrink_to_fit();
    return std::move(list_);
  }

 private:
  void sum_up() {
    const auto key = [](const SpeckContact& c) { return std::tie(c.speck, c.other); };
    std::sort(list_.begin(), list_.end(),
              [&](const SpeckContact& a, const SpeckContact& b) { return key(a) < key(b); });
    std::size_t kept = 0;
    for (const SpeckContact& contact : list_) {
      if (kept > 0 && key(list_[kept - 1]) == key(contact)) {
        list_[kept - 1].faces += contact.faces;
      } else {
        list_[kept++] = contact;
      }
    }
    list_.resize(kept);
    limit_ = std::max(kFirstLimit, 2 * kept);
  }

  static constexpr std::size_t kFirstLimit = std::size_t{1} << 16;
  std::size_t max_;
  std::size_t limit_ = kFirstLimit;
  std::vector<SpeckContact> list_;
};

class ContactFinder {
 public:
  ContactFinder(const SpeckRule& rule, const Specks& specks, const SpeckLimits& limits)
      : rule_(rule),
        specks_(specks),
        limits_(limits),
        list_((limits.memory - std::min(limits.memory, bytes_of_runs())) / kBytesPerSpeckContact) {}

  void read_row(RunPlanes& planes, std::int64_t y, std::int64_t z) {
    const std::span<LabelRun> row = planes.current.row(y);
    for (LabelRun& run : row) {
      run.part = speck_at(run, y, z);
      if (&run != row.data()) meet(run, *(&run - 1), 1);
      meet_row(planes.current.row(y - 1), run, true);
      meet_row(planes.below.row(y), run, true);
      if (!rule_.diagonal) continue;
      meet_row(planes.below.row(y - 1), run, false);
      meet_row(planes.below.row(y + 1), run, false);
    }
  }

  /// Returns the contacts.  The volume has changed if the runs of some specks were not seen again.
  SpeckContacts take() {
    if (next_ != specks_.runs.size()) fail_input_changed();
    return {list_.take(), std::move(labels_)};
  }

 private:
  [[nodiscard]] std::uint64_t bytes_of_runs() const {
    return specks_.runs.capacity() * sizeof(SpeckRun);
  }

  /// Returns the speck of a run.  Specks' runs are whole runs of the volume, in the same order.
  std::uint32_t speck_at(const LabelRun& run, std::int64_t y, std::int64_t z) {
    if (next_ == specks_.runs.size()) return kNoSpeck;
    const SpeckRun& next = specks_.runs[next_];
    if (next.z != z || next.y != y || next.begin != run.begin || next.end != run.end) {
      return kNoSpeck;
    }
    ++next_;
    return next.speck;
  }

  /// shares_faces is true if the row is next to the run's along y or z, not along both.
  void meet_row(std::span<LabelRun> row, const LabelRun& run, bool shares_faces) {
    for_each_touching(row, run, rule_.diagonal ? 1 : 0, [&](const LabelRun& other) {
      const std::int32_t overlap = std::min(run.end, other.end) - std::max(run.begin, other.begin);
      meet(run, other, shares_faces ? static_cast<std::uint64_t>(std::max(overlap, 0)) : 0);
    });
  }

  void meet(const LabelRun& a, const LabelRun& b, std::uint64_t faces) {
    if (a.part == b.part) return;  // one speck, or none
    add(a, b, faces);
    add(b, a, faces);
  }

  void add(const LabelRun& from, const LabelRun& to, std::uint64_t faces) {
    if (from.part == kNoSpeck || (to.part == kNoSpeck && faces == 0)) return;
    const std::uint32_t other = to.part == kNoSpeck ? index_of(to.label) : to.part;
    if (list_.add({from.part, other, faces})) return;
    fail_too_many_specks(rule_, specks_.labels.size(), limits_, specks_.memory);
  }

  std::uint32_t index_of(RawLabel label) {
    const auto next = static_cast<std::uint32_t>(labels_.size());
    const auto [found, is_new] = index_.try_emplace(label, next);
    if (is_new) labels_.push_back(label);
    return SpeckContact::kOfLabel + found->second;
  }

  SpeckRule rule_;
  const Specks& specks_;
  SpeckLimits limits_;
  ContactList list_;
  std::size_t next_ = 0;
  std::vector<RawLabel> labels_;
  std::unordered_map<RawLabel, std::uint32_t> index_;
};

}  // namespace

SpeckContacts find_contacts(const LabelVolume& volume, const SpeckRule& rule, const Specks& specks,
                            const SpeckLimits& limits) {
  ContactFinder finder(rule, specks, limits);
  sweep_runs(
      volume, limits.slab_voxels,
      [&](RunPlanes& planes, std::int64_t y, std::int64_t z) { finder.read_row(planes, y, z); },
      [](RunPlanes&, std::int64_t) {});
  return finder.take();
}

}  // namespace mw::io
