// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Records and bytes, group by group; and how a folder becomes smaller.
#include "engine/keep/kept_facts.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "engine/keep/window_records.h"
#include "engine/store/journal/folder_lock.h"
#include "engine/store/journal/mapped_file.h"
#include "io/file/folder.h"
#include "io/file/sink/partial_file.h"

namespace mw::engine {
namespace {

/// The log of a folder begins with a number of its own (KeepFolder::number()).
LogKind window_log(std::uint64_t folder) {
  return {.magic = 0x0200474F4C574D2EU + folder,  // ".MWLOG", version 0 2
          .name = "records of windows",
          .expected = "they do not begin as a log of version 2 of this folder"};
}

/// Gaps of more than one part in kMostGaps of the file are filled when a run ends.
constexpr std::uint64_t kMostGaps = 8;
constexpr const char* kCompactedFile = ".windows.partial-compacted";

[[noreturn]] void fail_overlapping() {
  throw DamagedWork("records of windows", "two point to the same bytes, or to none");
}

/// Returns the bytes that an extent takes of the file.
std::uint64_t sectors_of(const Extent& extent) {
  constexpr std::uint64_t kSector = ExtentAllocator::kSectorBytes;
  return (extent.size + kSector - 1) / kSector * kSector;
}

/// Removes the folder of another process.  Its lock goes last, since without it the other files
/// would count as somebody else's after a kill or a power cut.
void remove_part(const std::filesystem::path& part) {
  std::error_code ignored;  // what stays holds no records, and the next run removes it
  for (const std::string& name : io::entries_in(part, ignored)) {
    if (name != kLockFile) std::filesystem::remove(part / name, ignored);
  }
  io::sync_folder(part);
  std::filesystem::remove(part / kLockFile, ignored);
  std::filesystem::remove(part, ignored);
}

}  // namespace

KeptFacts::KeptFacts(KeepFolder& folder, const RunLayout& layout, const GroupCommit& limits)
    : folder_(folder),
      layout_(layout),
      limits_(limits),
      bytes_(folder.open(kVersionsFile)),
      record_at_(layout.windows(), 0),
      dropped_(layout.windows(), false),
      log_(std::make_unique<RecordLog>(folder.open(kWindowsFile), window_log(folder.number()))) {
  replay();
}

WindowRecord KeptFacts::checked(std::span<const std::byte> bytes) const {
  try {
    WindowRecord record = decode_window_record(bytes);
    if (record.window >= layout_.windows()) throw BadBytes{"there is no such window"};
    return record;
  } catch (const BadBytes& bad) {
    throw DamagedWork(window_log(0).name, bad.reason);
  }
}

void KeptFacts::replay() {
  log_->replay([&](std::uint64_t at, std::span<const std::byte> bytes) {
    record_at_[checked(bytes).window] = at + 1;
    ++records_;
  });
  each([&](const WindowRecord& record) {
    ++live_;
    run_ = std::max(run_, record.run + 1);
    dropped_[record.window] = record.is_dropped;
    if (record.extent.size > 0 && !bytes_.take(record.extent)) fail_overlapping();
  });
}

void KeptFacts::each(const std::function<void(const WindowRecord& record)>& use) const {
  for (std::uint64_t window = 0; window < record_at_.size(); ++window) {
    if (const std::optional<WindowRecord> record = of(window)) use(*record);
  }
}

std::optional<WindowRecord> KeptFacts::of(std::uint64_t window) const {
  std::uint64_t at = 0;
  {
    const std::lock_guard lock(mutex_);
    at = record_at_[window];
  }
  if (at == 0) return std::nullopt;
  std::optional<WindowRecord> out;
  log_->read(at - 1, [&](std::span<const std::byte> bytes) { out = checked(bytes); });
  return out;
}

WindowRecord KeptFacts::add(WindowRecord record, std::span<const std::byte> packed) {
  const std::optional<WindowRecord> old = of(record.window);
  bool full = false;
  {
    const std::lock_guard lock(mutex_);
    record.run = run_;
    if (!packed.empty()) record.extent = bytes_.write(packed);
    put(record, old);
    full = group_.size() >= limits_.windows || Clock::now() - group_since_ >= limits_.age;
  }
  if (full) {
    const std::unique_lock turn(saving_, std::try_to_lock);  // if it fails, another thread saves
    if (turn.owns_lock()) write_group();
  }
  return record;
}

/// REQUIRES: mutex_ is held.
void KeptFacts::put(const WindowRecord& record, const std::optional<WindowRecord>& old) {
  if (old && old->extent.size > 0) superseded_.push_back(old->extent);
  if (!old) ++live_;
  dropped_[record.window] = record.is_dropped;
  group_.push_back(record);
}

bool KeptFacts::has_dropped() const {
  return std::find(dropped_.begin(), dropped_.end(), true) != dropped_.end();
}

bool KeptFacts::any() const {
  const std::lock_guard lock(mutex_);
  return live_ > 0;
}

/// REQUIRES: saving_ is held.
void KeptFacts::write_group() {
  if (broken_) return;
  broken_ = true;  // until all went well
  std::vector<WindowRecord> group;
  std::vector<Extent> superseded;
  {
    const std::lock_guard lock(mutex_);
    group = std::exchange(group_, {});
    superseded = std::exchange(superseded_, {});
    group_since_ = Clock::now();
  }
  std::vector<std::uint64_t> places;
  if (!group.empty()) {
    bytes_.sync();
    folder_.stay();
    for (const WindowRecord& record : group) {
      places.push_back(log_->append(encode(record).written()));
    }
    log_->sync();
  }
  const std::lock_guard lock(mutex_);
  broken_ = false;
  for (std::size_t i = 0; i < group.size(); ++i) record_at_[group[i].window] = places[i] + 1;
  records_ += group.size();
  for (const Extent& extent : superseded) bytes_.release(extent);
}

void KeptFacts::save() {
  const std::lock_guard turn(saving_);
  write_group();
}

std::vector<std::uint64_t> KeptFacts::take_over_parts() {
  std::vector<std::uint64_t> by_march(layout_.marches());
  for (const std::filesystem::path& part : folder_.parts()) take_over(part, by_march);
  return by_march;
}

/// The records of the part are removed first, so that a folder half removed by a kill holds none.
void KeptFacts::take_over(const std::filesystem::path& part, std::vector<std::uint64_t>& by_march) {
  const std::filesystem::path records = part / kWindowsFile;
  if (std::filesystem::exists(records)) {
    RecordLog log(std::make_unique<MappedFile>(records), window_log(KeepFolder::number_of(part)));
    SegmentFile from(std::make_unique<MappedFile>(part / kVersionsFile));
    log.replay([&](std::uint64_t /*at*/, std::span<const std::byte> bytes) {
      WindowRecord record = checked(bytes);
      ++by_march[layout_.window_key(record.window).march];
      const Extent place = std::exchange(record.extent, {});
      if (place.size == 0) {
        add(std::move(record), {});
        return;
      }
      if (!from.take(place)) fail_overlapping();
      from.read(place, [&](std::span<const std::byte> packed) { add(record, packed); });
    });
    save();
    std::filesystem::remove(records);
  }
  remove_part(part);
}

/// Bytes that are given up leave gaps, not all of which can be filled, so it may take some rounds.
void KeptFacts::shrink_to(std::uint64_t folder_bytes) {
  const std::lock_guard turn(saving_);
  write_group();
  bool again = true;
  while (again) {
    bytes_.trim();
    move_down();
    compact_log();
    bytes_.trim();
    const std::uint64_t taken = folder_.bytes();
    again = taken > folder_bytes && drop(taken - folder_bytes);
  }
}

/// Puts a record in the place of a durable one.  Each full group is written at once, so that as
/// many records as a group has are in memory, and not one of each window. REQUIRES: saving_ is
/// held.
void KeptFacts::replace(const WindowRecord& record, const WindowRecord& old) {
  bool full = false;
  {
    const std::lock_guard lock(mutex_);
    put(record, old);
    full = group_.size() >= limits_.windows;
  }
  if (full) write_group();
}

/// Gives up at least `bytes` bytes, or all that may go.  Returns false if none may.
bool KeptFacts::drop(std::uint64_t bytes) {
  std::vector<KeptBytes> kept;
  kept.reserve(live_);
  each([&](const WindowRecord& record) {
    if (record.extent.size == 0) return;
    kept.push_back({record.window, record.run, sectors_of(record.extent)});
  });
  std::uint64_t given_up = 0;
  for (const KeptBytes& next : drop_order(layout_, std::move(kept), run_)) {
    if (given_up >= bytes) break;
    given_up += next.bytes;
    const auto old = of(next.window);
    WindowRecord record = *old;
    record.extent = {};
    record.is_dropped = true;
    for (KeptBlock& block : record.blocks) block.is_kept = false;
    replace(record, *old);
  }
  write_group();
  return given_up > 0;
}

std::optional<Extent> KeptFacts::copy_down(const Extent& extent) {
  const std::lock_guard lock(mutex_);
  return bytes_.copy_down(extent);
}

/// Moves bytes from the end of the file into gaps before them.  What moved leaves no gap before the
/// bytes that are looked at next, since these lie before it.
void KeptFacts::move_down() {
  std::vector<std::pair<std::uint64_t, std::uint64_t>> places;  // offset, window
  places.reserve(live_);
  each([&](const WindowRecord& record) {
    if (record.extent.size > 0) places.emplace_back(record.extent.offset, record.window);
  });
  std::sort(places.rbegin(), places.rend());
  for (const auto& [offset, window] : places) {
    const auto old = of(window);
    const std::optional<Extent> moved = copy_down(old->extent);
    if (!moved) continue;
    WindowRecord record = *old;
    record.extent = *moved;
    replace(record, *old);
  }
  write_group();
}

/// Replaces the log by one that has only the last record of each window.
void KeptFacts::compact_log() {
  if (records_ > live_) {
    const std::filesystem::path file = folder_.path() / kCompactedFile;
    std::filesystem::remove(file);
    auto compacted =
        std::make_unique<RecordLog>(folder_.open(kCompactedFile), window_log(folder_.number()));
    for (std::uint64_t& at : record_at_) {
      if (at == 0) continue;
      log_->read(at - 1,
                 [&](std::span<const std::byte> record) { at = compacted->append(record) + 1; });
    }
    compacted->sync();
    std::filesystem::rename(file, folder_.path() / kWindowsFile);
    io::sync_folder(folder_.path());  // before places that only the old log names are used again
    log_ = std::move(compacted);
    records_ = live_;
  }
  log_->trim();
}

void KeptFacts::finish() {
  const std::lock_guard turn(saving_);
  write_group();
  bytes_.trim();
  if (bytes_.free_bytes() > bytes_.end() / kMostGaps) move_down();
  bytes_.trim();
  if (records_ > 2 * live_) compact_log();
  log_->trim();
}

}  // namespace mw::engine
