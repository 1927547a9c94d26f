// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Records of a file, and those of the journal as bytes.
#include "engine/store/journal/journal.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/store/codec/byte_codes.h"
#include "io/codec/checksums.h"
#include "io/file/byte_order.h"

namespace mw::engine {
namespace {

constexpr LogKind kJournal{.magic = 0x01004C4E524A574DU,  // "MWJRNL", version 0 1
                           .name = "journal",
                           .expected = "it does not begin as a journal of version 1"};
constexpr std::size_t kBlockNumbers = 5;  ///< numbers of a block in a record, a byte each or more

ByteWriter encode(const JournalRecord& record, std::uint64_t number) {
  ByteWriter out;
  out.varint(number);
  out.varint(record.windows.size());
  for (std::uint64_t window : record.windows) out.varint(window);
  out.varint(record.blocks.size());
  for (const JournalBlock& b : record.blocks) {
    for (std::uint64_t v :
         {b.slot, b.extent.offset, b.extent.size, std::uint64_t{b.sum}, b.memory_bytes}) {
      out.varint(v);
    }
  }
  return out;
}

JournalBlock decode_block_extent(ByteReader& in) {
  constexpr std::uint64_t kSums = std::uint64_t{1} << 32;
  JournalBlock b;
  b.slot = in.varint();
  b.extent.offset = in.varint();
  b.extent.size = in.varint();
  b.sum = static_cast<std::uint32_t>(in.below(kSums));
  b.memory_bytes = in.varint();
  return b;
}

/// ERRORS: BadBytes.
JournalRecord decode(std::span<const std::byte> body, std::uint64_t number) {
  ByteReader in(body);
  if (in.varint() != number) throw BadBytes{"a record of another time"};
  JournalRecord record;
  record.windows.resize(in.count());
  for (std::uint64_t& window : record.windows) window = in.varint();
  const std::size_t blocks = in.count();
  record.blocks.reserve(std::min(blocks, body.size() / kBlockNumbers));
  for (std::size_t i = 0; i < blocks; ++i) record.blocks.push_back(decode_block_extent(in));
  if (!in.at_end()) throw BadBytes{"a record is too long"};
  return record;
}

}  // namespace

Journal::Journal(std::unique_ptr<WorkFile> file) : log_(std::move(file), kJournal) {}

bool Journal::read_next(JournalRecord& record) {
  return log_.next([&](std::uint64_t, std::span<const std::byte> body) {
    try {
      record = decode(body, records_);
      return true;
    } catch (const BadBytes&) {
      return false;  // the record counts as cut off
    }
  });
}

void Journal::replay(const std::function<void(const JournalRecord&)>& use) {
  JournalRecord record;
  for (; read_next(record); ++records_) use(record);
  log_.cut();
}

void Journal::scan(std::uint64_t count, const std::function<void(const JournalRecord&)>& use) {
  JournalRecord record;
  for (; records_ < count; ++records_) {
    if (!read_next(record)) throw DamagedWork("journal", "it ends before its last epoch");
    use(record);
  }
}

void Journal::append(const JournalRecord& record) {
  log_.append(encode(record, records_).written());
  log_.sync();
  ++records_;
}

namespace {

constexpr std::uint64_t kMagicBytes = 8;
constexpr std::uint64_t kHeadBytes = 8;  ///< length and checksum of a record
constexpr std::uint64_t kGrowBytes = 1 << 20;

template <class T>
T number_at(const WorkFile& file, std::uint64_t offset) {
  T value = 0;
  file.read(offset, sizeof(T), [&](std::span<const std::byte> bytes) {
    value = io::load<T>(bytes.data(), io::ByteOrder::kLittle);
  });
  return value;
}

/// True for some first bytes of the magic, or none, then zeros: a run was stopped in begin().  A
/// magic that itself ends with zeros is whole.
bool is_unfinished(std::uint64_t found, std::uint64_t magic) {
  if (found == magic) return false;
  for (unsigned bits = 0; bits < 8 * kMagicBytes; bits += 8) {
    if (found == (magic & ((std::uint64_t{1} << bits) - 1))) return true;
  }
  return false;
}

void begin(WorkFile& file, std::uint64_t magic) {
  file.resize(0);
  file.resize(kGrowBytes);
  std::array<std::byte, kMagicBytes> bytes{};
  io::store_little(magic, bytes.data());
  file.write(0, bytes);
  file.sync();
}

}  // namespace

RecordLog::RecordLog(std::unique_ptr<WorkFile> file, const LogKind& kind)
    : file_(std::move(file)), end_(kMagicBytes) {
  const auto magic = [&] { return number_at<std::uint64_t>(*file_, 0); };
  if (file_->size() < kMagicBytes || is_unfinished(magic(), kind.magic)) begin(*file_, kind.magic);
  if (magic() != kind.magic) throw DamagedWork(kind.name, kind.expected);
}

bool RecordLog::next(const TakeRecord& take) {
  if (file_->size() - end_ < kHeadBytes) return false;
  const auto length = number_at<std::uint32_t>(*file_, end_);
  const auto sum = number_at<std::uint32_t>(*file_, end_ + 4);
  if (length == 0 || length > file_->size() - end_ - kHeadBytes) return false;
  bool counts = false;
  file_->read(end_ + kHeadBytes, length, [&](std::span<const std::byte> record) {
    counts = io::checksum(record) == sum && take(end_, record);
  });
  if (counts) end_ += kHeadBytes + length;
  return counts;
}

void RecordLog::cut() {
  // Bytes that are added later are zeros, so that none of these is taken for a record.
  file_->resize(end_);
  // A killed run may not have synced its last records, and what they give up is free from now on.
  if (end_ > kMagicBytes) file_->sync();
}

void RecordLog::replay(const UseRecord& use) {
  const auto take = [&](std::uint64_t at, std::span<const std::byte> record) {
    use(at, record);
    return true;
  };
  while (next(take)) continue;
  cut();
}

std::uint64_t RecordLog::append(std::span<const std::byte> record) {
  const std::uint64_t at = end_, size = kHeadBytes + record.size();
  if (at + size > file_->size()) {
    file_->resize((at + size + kGrowBytes - 1) / kGrowBytes * kGrowBytes);
  }
  std::vector<std::byte> bytes(kHeadBytes);
  io::store_little(static_cast<std::uint32_t>(record.size()), bytes.data());
  io::store_little(io::checksum(record), bytes.data() + 4);
  bytes.insert(bytes.end(), record.begin(), record.end());
  file_->write(at, bytes);
  end_ += size;
  return at;
}

void RecordLog::read(std::uint64_t at, const UseBytes& use) const {
  const auto length = number_at<std::uint32_t>(*file_, at);
  file_->read(at + kHeadBytes, length, use);
}

}  // namespace mw::engine
