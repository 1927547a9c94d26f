// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Records of the journal as bytes.
#include "engine/store/journal/journal.h"

#include <algorithm>
#include <utility>

#include "engine/store/codec/byte_codes.h"
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

}  // namespace mw::engine
