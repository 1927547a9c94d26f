// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Encodes a block as bytes.
#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "engine/store/codec/block_codec.h"
#include "engine/store/codec/byte_codes.h"
#include "io/codec/checksums.h"
#include "kernels/core/sort_distinct.h"

namespace mw::engine {
namespace {

QuadricBits bits_of(const Quadric& q) {
  QuadricBits out{};
  for (std::size_t i = 0; i < 6; ++i) out[i] = std::bit_cast<std::uint64_t>(q.a[i]);
  for (std::size_t i = 0; i < 3; ++i) out[6 + i] = std::bit_cast<std::uint64_t>(q.b[i]);
  out[9] = std::bit_cast<std::uint64_t>(q.c);
  return out;
}

/// Returns the number of bytes from the highest down to the last that is not 0.
unsigned significant_bytes(std::uint64_t bits) {
  return bits == 0 ? 0 : kDoubleBytes - static_cast<unsigned>(std::countr_zero(bits)) / 8;
}

std::array<std::int64_t, 3> coordinates(Point p) {
  return {p.x, p.y, p.z};
}

class Encoder {
 public:
  Encoder(const BlockKey& key, const BlockMesh& mesh) : mesh_(mesh) {
    out_.low_bytes(kBlockMagic, 4);
    out_.low_bytes(0, 4);
    out_.low_bytes(0, 8);
    out_.varint(key.march);
    out_.varint(static_cast<std::uint64_t>(key.block.x));
    out_.varint(static_cast<std::uint64_t>(key.block.y));
    out_.varint(static_cast<std::uint64_t>(key.block.z));
    labels();
    vertices();
    tets();
    samples();
  }

  std::vector<std::byte> finish() {
    const std::span<std::byte> bytes = out_.written();
    io::store_little<std::uint64_t>(bytes.size(), bytes.data() + kBlockSizeAt);
    io::store_little<std::uint32_t>(io::checksum(bytes.subspan(kBlockSizeAt)),
                                    bytes.data() + kBlockSumAt);
    return {bytes.begin(), bytes.end()};
  }

 private:
  void labels() {
    const auto note = [this](Label label) {
      if (labels_.empty() || labels_.back() != label) labels_.push_back(label);
    };
    for (const BlockTet& t : mesh_.tets) note(t.label);
    for (const BlockSample& s : mesh_.samples) note(s.side);
    sort_distinct(labels_);
    out_.varint(labels_.size());
    Label before = 0;
    for (Label label : labels_) out_.varint(label - std::exchange(before, label));
  }

  void label(Label label) {
    if (labels_[last_label_] != label) {
      const auto index = std::lower_bound(labels_.begin(), labels_.end(), label);
      last_label_ = static_cast<std::size_t>(index - labels_.begin());
    }
    out_.varint(last_label_);
  }

  void vertices() {
    std::array<std::int64_t, 3> min{};
    if (!mesh_.vertices.empty()) min.fill(std::numeric_limits<std::int32_t>::max());
    for (const BlockVertex& v : mesh_.vertices) {
      const auto p = coordinates(v.position);
      for (std::size_t i = 0; i < 3; ++i) min[i] = std::min(min[i], p[i]);
    }
    out_.varint(mesh_.vertices.size());
    for (std::int64_t c : min) out_.varint(zigzag(c));
    VertexId before = 0;
    for (const BlockVertex& v : mesh_.vertices) {
      out_.varint(v.id - std::exchange(before, v.id));
      const auto p = coordinates(v.position);
      for (std::size_t i = 0; i < 3; ++i) out_.varint(static_cast<std::uint64_t>(p[i] - min[i]));
      quadric(bits_of(v.quadric));
    }
  }

  void quadric(const QuadricBits& bits) {
    std::uint64_t codes = 0;
    QuadricBits code{};
    for (std::size_t i = 0; i < bits.size(); ++i) {
      const bool repeats = i > 0 && bits[i] != 0 && bits[i] == bits[0];
      code[i] = repeats ? kSameAsFirst : significant_bytes(bits[i]);
      codes |= code[i] << 4 * i;
    }
    out_.low_bytes(codes, 5);
    for (std::size_t i = 0; i < bits.size(); ++i) {
      if (code[i] == 0 || code[i] == kSameAsFirst) continue;
      out_.low_bytes(bits[i] >> 8 * (kDoubleBytes - code[i]), code[i]);
    }
  }

  template <std::size_t n>
  void rows(const std::array<std::uint32_t, n>& rows, std::uint32_t& first_before) {
    out_.varint(rows[0] - std::exchange(first_before, rows[0]));
    for (std::size_t i = 1; i < n; ++i) out_.varint(rows[i] - rows[i - 1] - 1);
  }

  void tets() {
    out_.varint(mesh_.tets.size());
    std::uint32_t before = 0;
    for (const BlockTet& t : mesh_.tets) {
      rows(t.vertices, before);
      label(t.label);
    }
  }

  /// Returns the end of the list of samples that begins at `first`.
  [[nodiscard]] std::size_t list_end(std::size_t first) const {
    std::size_t end = first + 1;
    while (end < mesh_.samples.size() &&
           mesh_.samples[end].triangle == mesh_.samples[first].triangle &&
           mesh_.samples[end].side == mesh_.samples[first].side) {
      ++end;
    }
    return end;
  }

  void samples() {
    std::size_t lists = 0;
    for (std::size_t i = 0; i < mesh_.samples.size(); i = list_end(i)) ++lists;
    out_.varint(mesh_.samples.size());
    out_.varint(lists);
    std::uint32_t before = 0;
    FaceSamples last = 0;
    for (std::size_t i = 0; i < mesh_.samples.size();) {
      const std::size_t end = list_end(i);
      rows(mesh_.samples[i].triangle, before);
      label(mesh_.samples[i].side);
      out_.varint(end - i);
      const FaceSamples first = mesh_.samples[i].samples;
      out_.varint(zigzag(static_cast<std::int64_t>(first - std::exchange(last, first))));
      for (++i; i < end; ++i) {
        const FaceSamples sample = mesh_.samples[i].samples;
        out_.varint(sample - std::exchange(last, sample));
      }
    }
  }

  const BlockMesh& mesh_;
  std::vector<Label> labels_;
  std::size_t last_label_ = 0;  ///< the place of the label that was written last
  ByteWriter out_;
};

}  // namespace

std::vector<std::byte> encode_block(const BlockKey& key, const BlockMesh& mesh) {
  return Encoder(key, mesh).finish();
}

}  // namespace mw::engine
