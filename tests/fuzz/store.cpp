// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a run keeps on disk: blocks and journal, under checksums that are right.
#include <algorithm>
#include <cstring>

#include "engine/store/journal/journal.h"
#include "tests/engine/store/random_blocks.h"
#include "tests/engine/store/volatile_files.h"
#include "tests/fuzz/all_targets.h"
#include "tests/fuzz/choices.h"

namespace mw::fuzz {
namespace {

using engine::JournalRecord;
using engine::test::VolatileFiles;

bool is_canonical(const BlockMesh& mesh) {
  const auto by_id = [](const BlockVertex& a, const BlockVertex& b) { return a.id >= b.id; };
  const auto row_exists = [&](std::uint32_t row) { return row < mesh.vertices.size(); };
  return std::adjacent_find(mesh.vertices.begin(), mesh.vertices.end(), by_id) ==
             mesh.vertices.end() &&
         std::is_sorted(mesh.tets.begin(), mesh.tets.end()) &&
         std::is_sorted(mesh.samples.begin(), mesh.samples.end()) &&
         std::all_of(mesh.tets.begin(), mesh.tets.end(), [&](const BlockTet& t) {
           return std::ranges::all_of(t.vertices, row_exists);
         });
}

using Records = std::vector<JournalRecord>;

Records replayed(VolatileFiles& files) {
  Records out;
  engine::Journal(files.open("journal")).replay([&](const JournalRecord& r) { out.push_back(r); });
  return out;
}

void append(VolatileFiles::Bytes& out, Bytes bytes) {
  out.insert(out.end(), bytes.begin(), bytes.end());
}

template <class Number>
void append_number(VolatileFiles::Bytes& out, Number number) {
  std::array<std::byte, sizeof number> bytes{};
  io::store_little(number, bytes.data());
  append(out, bytes);
}

/// A journal whose bodies are the pieces of the bytes, each behind its length in a byte.
VolatileFiles::Bytes framed(Choices choices) {
  VolatileFiles::Bytes out;
  append(out, std::as_bytes(std::span("MWJRNL\0\1", 8)));
  while (!choices.at_end()) {
    const std::size_t claimed = choices.byte();
    const std::size_t size = std::min(claimed, choices.rest().size());
    const Bytes body = choices.rest().first(size);
    append_number(out, static_cast<std::uint32_t>(size));
    append_number(out, io::checksum(body));
    append(out, body);
    choices = Choices(choices.rest().subspan(size));
  }
  return out;
}

}  // namespace

/// The bytes behind the head of a block: refused, or a canonical mesh with an encoding of its own.
void fuzz_block(Bytes bytes) {
  const engine::BlockKey key{1, {3, 4, 5}};
  VolatileFiles::Bytes whole(16);
  std::memcpy(whole.data(), "MWB\2", 4);
  append(whole, bytes);
  engine::test::repair_head(whole);
  ends_well([&] {
    const BlockMesh mesh = engine::decode_block(key, whole);
    require(is_canonical(mesh), "what is decoded is canonical");
    require(engine::memory_bytes(mesh) <= 200 * whole.size(), "memory is bounded by the bytes");
    const BlockMesh again = engine::decode_block(key, engine::encode_block(key, mesh));
    require(engine::test::same_bits(mesh, again), "blocks come back");
  });
}

/// The first byte says whether the others are the file, or bodies of records.  What is replayed
/// stays, and what is appended then is replayed behind it.
void fuzz_journal(Bytes bytes) {
  Choices choices(bytes);
  VolatileFiles files;
  VolatileFiles::Bytes& content = files.content("journal");
  if (choices.below(2) == 0) {
    content = framed(choices);
  } else {
    append(content, choices.rest());
  }
  ends_well([&] {
    Records records = replayed(files);
    require(replayed(files) == records, "a journal is replayed the same way each time");
    records.push_back({{7}, {{1, {2, 3}, 4, 5}}});
    engine::Journal journal(files.open("journal"));
    journal.replay([](const JournalRecord&) {});
    journal.append(records.back());
    require(replayed(files) == records, "a record is appended behind the others");
  });
}

}  // namespace mw::fuzz
