// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Canonical blocks of arbitrary content, for tests of codec and store.
#pragma once

#include "engine/store/codec/block_codec.h"
#include "io/codec/checksums.h"
#include "io/file/byte_order.h"
#include "tests/testing.h"

namespace mw::engine::test {

/// Mostly small, now and then any number of 64 bits.
inline std::uint64_t random_number(std::mt19937& random) {
  const std::uint64_t any = std::uint64_t{random()} << 32 | random();
  return any >> (random() % 8 == 0 ? 0 : random() % 64);
}

/// Plain values, zeros of both signs, and any bits, NaN included.
inline double random_double(std::mt19937& random) {
  switch (random() % 4) {
    case 0:
      return random() % 2 == 0 ? 0.0 : -0.0;
    case 1:
      return static_cast<double>(random() % 16) / 4.0;
    case 2:
      return static_cast<double>(random()) * 1e-3 - 1e6;
    default:
      return std::bit_cast<double>(random_number(random));
  }
}

inline Quadric random_quadric(std::mt19937& random) {
  Quadric q;
  for (double& v : q.a) v = random_double(random);
  for (double& v : q.b) v = random_double(random);
  q.c = random_double(random);
  if (random() % 2 == 0) q.a[3] = q.a[5] = q.a[0];
  return q;
}

/// Ascending rows of a tet or a triangle.  REQUIRES: count >= n.
template <std::size_t n>
std::array<std::uint32_t, n> random_rows(std::mt19937& random, std::size_t count) {
  std::array<std::uint32_t, n> rows{};
  do {
    for (std::uint32_t& r : rows) r = static_cast<std::uint32_t>(random() % count);
    std::sort(rows.begin(), rows.end());
  } while (std::adjacent_find(rows.begin(), rows.end()) != rows.end());
  return rows;
}

inline void add_random_tets(BlockMesh& mesh, std::mt19937& random) {
  const std::size_t n = mesh.vertices.size();
  const auto label = [&] { return static_cast<Label>(random_number(random)); };
  const std::array<Label, 3> labels{label(), label(), kExterior};
  for (std::uint32_t v = 3; v < n; ++v) {
    mesh.tets.push_back({{v - 3, v - 2, v - 1, v}, labels[random() % 3]});
  }
  for (std::size_t i = random() % (2 * n); i > 0; --i) {
    mesh.tets.push_back({random_rows<4>(random, n), labels[random() % 3]});
  }
  for (std::size_t i = random() % (2 * n); i > 0; --i) {
    const auto triangle = random_rows<3>(random, n);
    for (std::size_t k = random() % 5; k > 0; --k) {
      mesh.samples.push_back({triangle, labels[random() % 3], random_number(random)});
    }
  }
}

/// A canonical block of up to about `size` vertices; sometimes empty.
inline BlockMesh random_block(std::mt19937& random, std::size_t size) {
  BlockMesh mesh;
  const std::size_t n = random() % (size + 1);
  if (n < 4) return mesh;
  std::vector<VertexId> ids(n);
  for (VertexId& id : ids) id = random_number(random);
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  if (ids.size() < 4) return mesh;
  const auto coordinate = [&] { return static_cast<std::int32_t>(random_number(random)); };
  for (VertexId id : ids) {
    mesh.vertices.push_back(
        {id, {coordinate(), coordinate(), coordinate()}, random_quadric(random)});
  }
  add_random_tets(mesh, random);
  std::sort(mesh.tets.begin(), mesh.tets.end());
  mesh.tets.erase(std::unique(mesh.tets.begin(), mesh.tets.end()), mesh.tets.end());
  std::sort(mesh.samples.begin(), mesh.samples.end());
  return mesh;
}

/// Equal bit by bit; operator== calls NaN unequal and both zeros equal.
inline bool same_bits(const BlockMesh& a, const BlockMesh& b) {
  const auto same = [](const BlockVertex& v, const BlockVertex& w) {
    const auto bits = std::bit_cast<std::array<std::uint64_t, 10>, Quadric>;
    return v.id == w.id && v.position == w.position && bits(v.quadric) == bits(w.quadric);
  };
  return a.tets == b.tets && a.samples == b.samples &&
         std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin(), b.vertices.end(),
                    same);
}

/// Makes length and checksum of changed bytes right again.
inline void repair_head(std::vector<std::byte>& bytes) {
  if (bytes.size() < 16) return;
  io::store_little<std::uint64_t>(bytes.size(), bytes.data() + 8);
  io::store_little<std::uint32_t>(io::checksum(std::span(bytes).subspan(8)), bytes.data() + 4);
}

}  // namespace mw::engine::test
