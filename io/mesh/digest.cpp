// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The digest of a mesh's content by external sorting.
#include "io/mesh/digest.h"

#include <algorithm>

#include "io/codec/hasher.h"
#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/mesh/tet_record.h"

namespace mw::io {
namespace {

/// Returns the bits of the double that sortable() gave this number.
std::uint64_t unsortable(std::uint64_t key) {
  return (key >> 63) != 0 ? key & ~(std::uint64_t{1} << 63) : ~key;
}

/// Hashes the vertices in order and adds the rank of each row to ranks.
void hash_vertices(ExternalSort<4>& positions, ExternalSort<2>& ranks, Hasher& hasher) {
  std::uint64_t position = 0;
  std::uint64_t rank = 0;
  std::array<std::uint64_t, 3> last{};
  positions.each([&](const std::array<std::uint64_t, 4>& vertex) {
    const std::array<std::uint64_t, 3> key{vertex[0], vertex[1], vertex[2]};
    if (key != last) rank = position;
    last = key;
    ranks.add({vertex[3], rank});
    for (const std::uint64_t coordinate : key) hasher.add(unsortable(coordinate));
    ++position;
  });
}

/// Adds the tets to keys, with ranks in the place of rows.
void rank_tets(const PackedRecords<TetRecord>& tet_rows, PagedFile<std::uint64_t>& rank,
               ExternalSort<5>& keys) {
  tet_rows.each_batch([&](std::span<const TetRecord> batch) {
    for (TetRecord tet : batch) {
      for (std::size_t i = 0; i < 4; ++i) {
        if (tet[i] >= rank.size()) {
          throw Error(ErrorKind::kInternal,
                      text("digest: a tet names vertex ", tet[i], " of ", rank.size()));
        }
        tet[i] = rank[tet[i]];
      }
      std::sort(tet.begin(), tet.begin() + 4);
      keys.add(tet);
    }
  });
}

}  // namespace

DigestSink::DigestSink(const std::filesystem::path& folder, std::size_t memory_bytes)
    : folder_(folder),
      memory_bytes_(memory_bytes),
      positions_(folder, memory_bytes),
      tet_rows_(folder) {}

void DigestSink::write_vertices(std::span<const Position> positions) {
  for (const Position& p : positions) {
    positions_.add({sortable(p[0]), sortable(p[1]), sortable(p[2]), vertices_++});
  }
}

void DigestSink::write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) {
  append_tets(tet_rows_, tets, labels);
  tets_ += tets.size();
}

std::string DigestSink::digest() {
  Hasher hasher;
  hasher.add(std::string_view("mwmesh-digest-1"));
  hasher.add(vertices_);
  hasher.add(tets_);
  PagedFile<std::uint64_t> rank(folder_);
  {
    ExternalSort<2> ranks(folder_, memory_bytes_);
    hash_vertices(positions_, ranks, hasher);
    ranks.each([&](const std::array<std::uint64_t, 2>& row) { rank.append(row[1]); });
  }
  ExternalSort<5> keys(folder_, memory_bytes_);
  rank_tets(tet_rows_, rank, keys);
  keys.each([&](const TetRecord& tet) {
    for (const std::uint64_t number : tet) hasher.add(number);
  });
  return "sha256:" + hasher.finish();
}

}  // namespace mw::io
