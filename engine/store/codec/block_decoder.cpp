// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Decodes a block from bytes, or throws an error that says what is wrong with them.
#include <algorithm>
#include <bit>

#include "engine/store/codec/block_codec.h"
#include "engine/store/codec/byte_codes.h"
#include "engine/store/journal/work_file.h"
#include "io/codec/checksums.h"
#include "io/file/errors.h"

namespace mw::engine {
namespace {

Quadric quadric_of(const QuadricBits& bits) {
  Quadric out;
  for (std::size_t i = 0; i < 6; ++i) out.a[i] = std::bit_cast<double>(bits[i]);
  for (std::size_t i = 0; i < 3; ++i) out.b[i] = std::bit_cast<double>(bits[6 + i]);
  out.c = std::bit_cast<double>(bits[9]);
  return out;
}

class Decoder {
 public:
  Decoder(const BlockKey& key, std::span<const std::byte> bytes) : in_(bytes) {
    check_head(bytes);
    const BlockKey found = read_key();
    if (!(found == key)) throw BadBytes{"these are the bytes of another block"};
    labels();
    vertices();
    tets();
    samples();
    if (!in_.at_end()) throw BadBytes{"it has bytes after its end"};
    require_all_used();
  }

  BlockMesh take() { return std::move(mesh_); }

 private:
  void check_head(std::span<const std::byte> bytes) {
    if (bytes.size() < kBlockHeadBytes) throw BadBytes{"it ends too early"};
    if (in_.low_bytes(4) != kBlockMagic)
      throw BadBytes{"it does not begin as a block of version 2"};
    const std::uint64_t sum = in_.low_bytes(4);
    if (in_.low_bytes(8) != bytes.size()) throw BadBytes{"its length is wrong"};
    if (io::checksum(bytes.subspan(kBlockSizeAt)) != sum) {
      throw BadBytes{"its checksum is wrong"};
    }
  }

  BlockKey read_key() {
    constexpr std::uint64_t kMarches = std::uint64_t{1} << 32;
    constexpr std::uint64_t kBlocks = std::uint64_t{1} << 62;
    BlockKey key{static_cast<std::uint32_t>(in_.below(kMarches)), {}};
    key.block.x = static_cast<std::int64_t>(in_.below(kBlocks));
    key.block.y = static_cast<std::int64_t>(in_.below(kBlocks));
    key.block.z = static_cast<std::int64_t>(in_.below(kBlocks));
    return key;
  }

  void labels() {
    labels_.resize(in_.count());
    std::uint64_t label = 0;
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      const std::uint64_t step = in_.below(kExterior + std::uint64_t{1});
      label += step;
      if (label > kExterior || (i > 0 && step == 0)) throw BadBytes{"its labels do not ascend"};
      labels_[i] = static_cast<Label>(label);
    }
  }

  Label label() { return labels_[in_.below(labels_.size())]; }

  void vertices() {
    mesh_.vertices.resize(in_.count());
    std::array<std::int64_t, 3> min{};
    for (std::int64_t& c : min) c = coordinate(unzigzag(in_.varint()));
    VertexId before = 0;
    for (std::size_t i = 0; i < mesh_.vertices.size(); ++i) {
      BlockVertex& v = mesh_.vertices[i];
      const std::uint64_t step = in_.varint();
      v.id = before + step;
      if (i > 0 && v.id <= before) throw BadBytes{"its vertex ids do not ascend"};
      before = v.id;
      std::array<std::int32_t, 3> p{};
      for (std::size_t k = 0; k < 3; ++k) {
        constexpr std::uint64_t kRange = std::uint64_t{1} << 32;
        p[k] = coordinate(min[k] + static_cast<std::int64_t>(in_.below(kRange)));
      }
      v.position = {p[0], p[1], p[2]};
      v.quadric = quadric();
    }
  }

  static std::int32_t coordinate(std::int64_t value) {
    if (value != static_cast<std::int32_t>(value)) throw BadBytes{"a position is out of range"};
    return static_cast<std::int32_t>(value);
  }

  Quadric quadric() {
    const std::uint64_t codes = in_.low_bytes(5);
    QuadricBits bits{};
    for (std::size_t i = 0; i < bits.size(); ++i) {
      const std::uint64_t code = codes >> 4 * i & 15;
      if (code == 0) continue;
      if (code > kSameAsFirst || (code == kSameAsFirst && i == 0)) {
        throw BadBytes{"a quadric has an unknown code"};
      }
      bits[i] = code == kSameAsFirst ? bits[0] : in_.low_bytes(code) << 8 * (kDoubleBytes - code);
    }
    return quadric_of(bits);
  }

  template <std::size_t n>
  void rows(std::array<std::uint32_t, n>& rows, std::uint32_t& first_before) {
    std::uint64_t row = std::uint64_t{first_before} + in_.below(mesh_.vertices.size());
    for (std::size_t i = 0; i < n; ++i) {
      if (i > 0) row += in_.below(mesh_.vertices.size()) + 1;
      if (row >= mesh_.vertices.size()) throw BadBytes{"a row is beyond its vertices"};
      rows[i] = static_cast<std::uint32_t>(row);
    }
    first_before = rows[0];
  }

  void tets() {
    mesh_.tets.resize(in_.count());
    std::uint32_t before = 0;
    for (std::size_t i = 0; i < mesh_.tets.size(); ++i) {
      BlockTet& t = mesh_.tets[i];
      rows(t.vertices, before);
      t.label = label();
      if (i > 0 && !is_before(mesh_.tets[i - 1], t)) throw BadBytes{"its tets do not ascend"};
    }
  }

  /// Replaces <, which compares number by number.
  static bool is_before(const BlockTet& s, const BlockTet& t) {
    const auto two = [](std::uint32_t high, std::uint32_t low) {
      return std::uint64_t{high} << 32 | low;
    };
    const auto &u = s.vertices, &v = t.vertices;
    const std::uint64_t first = two(u[0], u[1]), other = two(v[0], v[1]);
    if (first != other) return first < other;
    const std::uint64_t second = two(u[2], u[3]), last = two(v[2], v[3]);
    return second != last ? second < last : s.label < t.label;
  }

  void samples() {
    const std::size_t total = in_.count();
    const std::size_t lists = in_.count();
    mesh_.samples.reserve(total);
    std::uint32_t before = 0;
    FaceSamples last = 0;
    for (std::size_t i = 0; i < lists; ++i) {
      BlockSample s;
      rows(s.triangle, before);
      s.side = label();
      const std::size_t count = in_.count();
      last += static_cast<FaceSamples>(unzigzag(in_.varint()));
      if (count == 0) throw BadBytes{"a list of samples is empty"};
      for (std::size_t k = 0; k < count; ++k) {
        const std::uint64_t step = k == 0 ? 0 : in_.varint();
        if (step > ~last) throw BadBytes{"its samples do not ascend"};
        s.samples = last += step;
        if (!mesh_.samples.empty() && s < mesh_.samples.back()) {
          throw BadBytes{"its samples do not ascend"};
        }
        mesh_.samples.push_back(s);
      }
    }
    if (mesh_.samples.size() != total) throw BadBytes{"its number of samples is wrong"};
  }

  void require_all_used() const {
    std::vector<char> used(mesh_.vertices.size(), 0);
    for (const BlockTet& t : mesh_.tets) {
      for (std::uint32_t row : t.vertices) used[row] = 1;
    }
    if (std::find(used.begin(), used.end(), 0) != used.end()) {
      throw BadBytes{"a vertex belongs to no tet"};
    }
  }

  ByteReader in_;
  std::vector<Label> labels_;
  BlockMesh mesh_;
};

template <class T>
std::uint64_t list_bytes(const std::vector<T>& list) {
  return list.size() * sizeof(T);
}

}  // namespace

BlockMesh decode_block(const BlockKey& key, std::span<const std::byte> bytes) {
  try {
    return Decoder(key, bytes).take();
  } catch (const BadBytes& bad) {
    throw DamagedWork(name(key), bad.reason);
  }
}

std::uint64_t memory_bytes(const BlockMesh& mesh) {
  return list_bytes(mesh.vertices) + list_bytes(mesh.tets) + list_bytes(mesh.samples);
}

std::string name(const BlockKey& key) {
  return io::text("block (", key.block.x, ", ", key.block.y, ", ", key.block.z, ") of march ",
                  key.march + 1);
}

}  // namespace mw::engine
