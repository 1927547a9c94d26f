// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Turns records into bytes and back, and finds where the whole ones end.
#include "engine/store/journal/journal.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/store/codec/byte_codes.h"
#include "engine/store/journal/work_file.h"
#include "io/codec/checksums.h"
#include "io/file/errors.h"
#include "kernels/core/assert.h"

namespace mw::engine {
namespace {

constexpr std::uint64_t kMagic = 0x01004C4E524A574DU;  // "MWJRNL", version 0 1
constexpr std::uint64_t kMagicBytes = 8;
constexpr std::uint64_t kHeadBytes = 8;  ///< length and checksum of a record
constexpr std::uint64_t kGrowBytes = 1 << 20;
constexpr std::size_t kBlockNumbers = 5;  ///< numbers of a block in a record, a byte each or more

std::uint64_t number_at(const WorkFile& file, std::uint64_t offset, std::size_t bytes) {
  std::uint64_t value = 0;
  file.read(offset, bytes,
            [&](std::span<const std::byte> read) { value = ByteReader(read).low_bytes(bytes); });
  return value;
}

/// True for some first bytes of the magic, or none, then zeros: a run was stopped in begin().
bool is_unfinished(std::uint64_t magic) {
  for (unsigned bits = 0; bits < 8 * kMagicBytes; bits += 8) {
    if (magic == (kMagic & ((std::uint64_t{1} << bits) - 1))) return true;
  }
  return false;
}

ByteWriter encode(const JournalRecord& record, std::uint64_t number) {
  ByteWriter out;
  out.low_bytes(0, kHeadBytes);
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
  const std::span<std::byte> bytes = out.written();
  const std::span<std::byte> body = bytes.subspan(kHeadBytes);
  io::store_little(static_cast<std::uint32_t>(body.size()), bytes.data());
  io::store_little(io::checksum(body), bytes.data() + 4);
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

Journal::Journal(std::unique_ptr<WorkFile> file) : file_(std::move(file)) {
  if (file_->size() < kMagicBytes || is_unfinished(number_at(*file_, 0, kMagicBytes))) begin();
  if (number_at(*file_, 0, kMagicBytes) != kMagic) {
    throw DamagedWork("journal", "it does not begin as a journal of version 1");
  }
  end_ = kMagicBytes;
}

void Journal::begin() {
  file_->resize(0);
  file_->resize(kGrowBytes);
  ByteWriter magic;
  magic.low_bytes(kMagic, kMagicBytes);
  file_->write(0, magic.written());
  file_->sync();
}

bool Journal::read_next(JournalRecord& record) {
  if (file_->size() - end_ < kHeadBytes) return false;
  const std::uint64_t length = number_at(*file_, end_, 4);
  const std::uint64_t sum = number_at(*file_, end_ + 4, 4);
  if (length == 0 || length > file_->size() - end_ - kHeadBytes) return false;
  bool whole = false;
  file_->read(end_ + kHeadBytes, length, [&](std::span<const std::byte> body) {
    if (io::checksum(body) != sum) return;
    try {
      record = decode(body, records_);
      whole = true;
    } catch (const BadBytes&) {
      return;  // the record counts as cut off
    }
  });
  if (whole) end_ += kHeadBytes + length;
  return whole;
}

void Journal::replay(const std::function<void(const JournalRecord&)>& use) {
  JournalRecord record;
  for (; read_next(record); ++records_) use(record);
  file_->resize(end_);
  if (records_ > 0) file_->sync();
}

void Journal::scan(std::uint64_t count, const std::function<void(const JournalRecord&)>& use) {
  JournalRecord record;
  for (; records_ < count; ++records_) {
    if (!read_next(record)) throw DamagedWork("journal", "it ends before its last epoch");
    use(record);
  }
}

void Journal::make_room(std::uint64_t size) {
  if (end_ + size <= file_->size()) return;
  file_->resize((end_ + size + kGrowBytes - 1) / kGrowBytes * kGrowBytes);
}

void Journal::append(const JournalRecord& record) {
  ByteWriter bytes = encode(record, records_);
  make_room(bytes.size());
  file_->write(end_, bytes.written());
  file_->sync();
  end_ += bytes.size();
  ++records_;
}

}  // namespace mw::engine
