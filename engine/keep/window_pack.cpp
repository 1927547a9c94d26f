// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Turns kept blocks into columns and back.
#include "engine/keep/window_pack.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "engine/store/codec/byte_codes.h"
#include "io/codec/checksums.h"
#include "io/codec/codec.h"

namespace mw::engine {
namespace {

/// Values of one kind.  Vertices that an earlier block has as well are in kIds and kSeen alone.
enum Column : std::size_t {
  kCounts,        ///< lengths of all lists, and the labels
  kIds,           ///< ids of vertices, as steps
  kSeen,          ///< 1: an earlier block has the vertex, 0: it follows in the next columns
  kNear,          ///< positions minus those of the vertex before, zigzag: the lowest bytes
  kFar,           ///< the second bytes of these
  kFarther,       ///< the rest of these
  kQuadricCodes,  ///< 5 bytes each
  kFirstBytes,    ///< first bytes of the quadrics' numbers, a column for each kind (kKindOf)
  kSecondBytes = kFirstBytes + 4,
  kOtherBytes = kSecondBytes + 4,
  kFirstRows,  ///< first rows of tets
  kOtherRows,
  kTetLabels,
  kFirstCorners,  ///< first corners of lists of samples
  kOtherCorners,
  kSides,
  kListSizes,
  kQuarters,  ///< the lowest 6 bits of samples (face_sample.h)
  kAlong,     ///< the voxels of samples minus the ones before, zigzag, x y z
  kColumns = kAlong + 3,
};

/// Which numbers of a quadric are alike: the diagonal of A, the rest of A, b, c.
constexpr std::array<std::size_t, 10> kKindOf{0, 1, 1, 0, 1, 0, 2, 2, 2, 3};

constexpr std::size_t kSumBytes = 4;
/// A shorter column does not get a frame of its own.
constexpr std::size_t kLongColumn = 512;

constexpr std::array<unsigned, 3> kSampleShift{6, 25, 44};
constexpr std::array<std::uint64_t, 3> kSampleMask{0x7ffff, 0x7ffff, 0xfffff};
constexpr std::uint64_t kSampleRest = 63;  ///< axis and quarters

/// A vertex of an earlier block.
struct KnownVertex {
  std::uint64_t id = 0;
  std::array<std::int64_t, 3> position{};
  std::uint64_t codes = 0;
  std::size_t quadric = 0;  ///< where its bytes begin
};

std::size_t code_of(std::uint64_t codes, std::size_t number) {
  return codes >> 4 * number & 15;
}

/// Returns how many bytes of a number follow.
std::size_t stored_bytes(std::uint64_t codes, std::size_t number) {
  const std::size_t code = code_of(codes, number);
  return code == kSameAsFirst ? 0 : code;
}

std::size_t quadric_bytes(std::uint64_t codes) {
  std::size_t sum = 0;
  for (std::size_t i = 0; i < kKindOf.size(); ++i) sum += stored_bytes(codes, i);
  return sum;
}

/// The vertices of the blocks so far, ascending, each id once.
class KnownVertices {
 public:
  /// Returns null if no vertex has that id.  REQUIRES: ids of one block ascend from call to call.
  const KnownVertex* find(std::uint64_t id) {
    while (next_ < known_.size() && known_[next_].id < id) ++next_;
    return next_ < known_.size() && known_[next_].id == id ? &known_[next_] : nullptr;
  }
  /// Takes a vertex of the present block; find() finds it from the next block on.
  void add(const KnownVertex& vertex) { fresh_.push_back(vertex); }
  void end_block() {
    std::vector<KnownVertex> all;
    all.reserve(known_.size() + fresh_.size());
    const auto by_id = [](const KnownVertex& a, const KnownVertex& b) { return a.id < b.id; };
    std::merge(known_.begin(), known_.end(), fresh_.begin(), fresh_.end(), std::back_inserter(all),
               by_id);
    known_ = std::move(all);
    fresh_.clear();
    next_ = 0;
  }

  std::vector<std::byte> quadrics;  ///< bytes of all their quadrics

 private:
  std::vector<KnownVertex> known_, fresh_;
  std::size_t next_ = 0;
};

/// The voxel and the rest of a sample.
struct SplitSample {
  std::array<std::int64_t, 3> voxel{};
  std::uint64_t rest = 0;
};

SplitSample split(std::uint64_t sample) {
  SplitSample out{.voxel = {}, .rest = sample & kSampleRest};
  for (std::size_t i = 0; i < 3; ++i) {
    out.voxel[i] = static_cast<std::int64_t>(sample >> kSampleShift[i] & kSampleMask[i]);
  }
  return out;
}

std::uint64_t joined(const SplitSample& sample) {
  std::uint64_t out = sample.rest;
  for (std::size_t i = 0; i < 3; ++i) {
    out |= (static_cast<std::uint64_t>(sample.voxel[i]) & kSampleMask[i]) << kSampleShift[i];
  }
  return out;
}

class ColumnWriter {
 public:
  void add(std::span<const std::byte> block) {
    ByteReader in(block);
    labels(in);
    vertices(in);
    tets(in);
    samples(in);
  }

  std::array<ByteWriter, kColumns> columns;

 private:
  std::uint64_t copy(ByteReader& in, std::size_t column) {
    const std::uint64_t value = in.varint();
    columns[column].varint(value);
    return value;
  }
  void byte(std::size_t column, std::uint64_t value) { columns[column].low_bytes(value, 1); }

  void labels(ByteReader& in) {
    for (std::uint64_t n = copy(in, kCounts); n > 0; --n) copy(in, kCounts);
  }

  void vertices(ByteReader& in) {
    const std::uint64_t count = copy(in, kCounts);
    std::array<std::int64_t, 3> least{};
    for (std::int64_t& c : least) c = unzigzag(in.varint());
    KnownVertex vertex;
    for (std::uint64_t n = count; n > 0; --n) {
      vertex.id += copy(in, kIds);
      for (std::size_t i = 0; i < 3; ++i) {
        vertex.position[i] = least[i] + static_cast<std::int64_t>(in.varint());
      }
      vertex.codes = in.low_bytes(5);
      const std::span<const std::byte> quadric = in.bytes(quadric_bytes(vertex.codes));
      if (is_known(vertex, quadric)) {
        byte(kSeen, 1);
        continue;
      }
      byte(kSeen, 0);
      write(vertex, quadric);
    }
    known_.end_block();
  }

  bool is_known(const KnownVertex& vertex, std::span<const std::byte> quadric) {
    const KnownVertex* const same = known_.find(vertex.id);
    return same != nullptr && same->position == vertex.position && same->codes == vertex.codes &&
           std::equal(quadric.begin(), quadric.end(), known_.quadrics.data() + same->quadric);
  }

  void write(KnownVertex& vertex, std::span<const std::byte> quadric) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint64_t step = zigzag(vertex.position[i] - last_[i]);
      byte(kNear, step);
      byte(kFar, step >> 8U);
      columns[kFarther].varint(step >> 16U);
    }
    last_ = vertex.position;
    columns[kQuadricCodes].low_bytes(vertex.codes, 5);
    std::size_t at = 0;
    for (std::size_t i = 0; i < kKindOf.size(); ++i) {
      const std::size_t bytes = stored_bytes(vertex.codes, i);
      at += bytes;  // the highest byte of a number is the last
      for (std::size_t k = 0; k < bytes; ++k) {
        byte(column_of(i, k), static_cast<std::uint64_t>(quadric[at - 1 - k]));
      }
    }
    vertex.quadric = known_.quadrics.size();
    known_.quadrics.insert(known_.quadrics.end(), quadric.begin(), quadric.end());
    known_.add(vertex);
  }

 public:
  /// Returns the column of the k-th byte of a number.
  static std::size_t column_of(std::size_t number, std::size_t k) {
    if (k > 1) return kOtherBytes;
    return (k == 0 ? kFirstBytes : kSecondBytes) + kKindOf[number];
  }

 private:
  void tets(ByteReader& in) {
    for (std::uint64_t n = copy(in, kCounts); n > 0; --n) {
      copy(in, kFirstRows);
      for (int i = 0; i < 3; ++i) copy(in, kOtherRows);
      copy(in, kTetLabels);
    }
  }

  void samples(ByteReader& in) {
    copy(in, kCounts);
    std::uint64_t last = 0;
    std::array<std::int64_t, 3> voxel{};
    for (std::uint64_t lists = copy(in, kCounts); lists > 0; --lists) {
      copy(in, kFirstCorners);
      for (int i = 0; i < 2; ++i) copy(in, kOtherCorners);
      copy(in, kSides);
      const std::uint64_t count = copy(in, kListSizes);
      for (std::uint64_t k = 0; k < count; ++k) {
        const std::uint64_t step = in.varint();
        last += k == 0 ? static_cast<std::uint64_t>(unzigzag(step)) : step;
        const SplitSample sample = split(last);
        byte(kQuarters, sample.rest);
        for (std::size_t i = 0; i < 3; ++i) {
          columns[kAlong + i].varint(zigzag(sample.voxel[i] - voxel[i]));
        }
        voxel = sample.voxel;
      }
    }
  }

  KnownVertices known_;
  std::array<std::int64_t, 3> last_{};
};

class ColumnReader {
 public:
  explicit ColumnReader(const std::array<std::vector<std::byte>, kColumns>& columns) {
    for (const std::vector<std::byte>& column : columns) in_.emplace_back(column);
  }

  /// Returns the next block, as it was.
  std::vector<std::byte> next() {
    ByteWriter out;
    labels(out);
    vertices(out);
    tets(out);
    samples(out);
    const std::span<std::byte> bytes = out.written();
    return {bytes.begin(), bytes.end()};
  }

  /// Goes past the next block, and notes its vertices, which later blocks may share.
  void pass() {
    in_[kCounts].pass(in_[kCounts].varint());
    static_cast<void>(read_vertices(in_[kCounts].varint()));
    const std::uint64_t tets = in_[kCounts].varint();
    in_[kFirstRows].pass(tets);
    in_[kOtherRows].pass(3 * tets);
    in_[kTetLabels].pass(tets);
    const std::uint64_t samples = in_[kCounts].varint(), lists = in_[kCounts].varint();
    in_[kFirstCorners].pass(lists);
    in_[kOtherCorners].pass(2 * lists);
    in_[kSides].pass(lists);
    in_[kListSizes].pass(lists);
    static_cast<void>(in_[kQuarters].bytes(samples));
    for (std::size_t i = 0; i < 3; ++i) in_[kAlong + i].pass(samples);
  }

 private:
  struct Vertices {
    std::vector<std::uint64_t> steps;  ///< steps of their ids
    std::vector<KnownVertex> all;
  };

  std::uint64_t copy(std::size_t column, ByteWriter& out) {
    const std::uint64_t value = in_[column].varint();
    out.varint(value);
    return value;
  }
  std::uint64_t byte(std::size_t column) { return in_[column].low_bytes(1); }

  void labels(ByteWriter& out) {
    for (std::uint64_t n = copy(kCounts, out); n > 0; --n) copy(kCounts, out);
  }

  void vertices(ByteWriter& out) { write(read_vertices(copy(kCounts, out)), out); }

  Vertices read_vertices(std::uint64_t count) {
    Vertices out;
    std::uint64_t id = 0;
    for (std::uint64_t n = count; n > 0; --n) {
      out.steps.push_back(in_[kIds].varint());
      id += out.steps.back();
      const KnownVertex* const known = known_.find(id);
      if (byte(kSeen) == 0) {
        out.all.push_back(read(id));
      } else if (known != nullptr) {
        out.all.push_back(*known);
      } else {
        throw BadBytes{"a vertex is in no earlier block"};
      }
    }
    known_.end_block();
    return out;
  }

  KnownVertex read(std::uint64_t id) {
    KnownVertex vertex{.id = id, .position = last_, .codes = 0, .quadric = known_.quadrics.size()};
    for (std::int64_t& along : vertex.position) {
      const std::uint64_t low = byte(kNear), high = byte(kFar);
      along += unzigzag(low | high << 8U | in_[kFarther].varint() << 16U);
    }
    last_ = vertex.position;
    vertex.codes = in_[kQuadricCodes].low_bytes(5);
    for (std::size_t i = 0; i < kKindOf.size(); ++i) {
      const std::size_t bytes = stored_bytes(vertex.codes, i);
      known_.quadrics.resize(known_.quadrics.size() + bytes);
      for (std::size_t k = 0; k < bytes; ++k) {
        known_.quadrics[known_.quadrics.size() - 1 - k] =
            static_cast<std::byte>(byte(ColumnWriter::column_of(i, k)));
      }
    }
    known_.add(vertex);
    return vertex;
  }

  void write(const Vertices& vertices, ByteWriter& out) const {
    std::array<std::int64_t, 3> least{};
    if (!vertices.all.empty()) least = vertices.all[0].position;
    for (const KnownVertex& v : vertices.all) {
      for (std::size_t i = 0; i < 3; ++i) least[i] = std::min(least[i], v.position[i]);
    }
    for (std::int64_t c : least) out.varint(zigzag(c));
    for (std::size_t n = 0; n < vertices.all.size(); ++n) {
      const KnownVertex& v = vertices.all[n];
      out.varint(vertices.steps[n]);
      for (std::size_t i = 0; i < 3; ++i) {
        out.varint(static_cast<std::uint64_t>(v.position[i] - least[i]));
      }
      out.low_bytes(v.codes, 5);
      out.append(std::span(known_.quadrics).subspan(v.quadric, quadric_bytes(v.codes)));
    }
  }

  void tets(ByteWriter& out) {
    for (std::uint64_t n = copy(kCounts, out); n > 0; --n) {
      copy(kFirstRows, out);
      for (int i = 0; i < 3; ++i) copy(kOtherRows, out);
      copy(kTetLabels, out);
    }
  }

  void samples(ByteWriter& out) {
    copy(kCounts, out);
    std::uint64_t last = 0;
    SplitSample sample;
    for (std::uint64_t lists = copy(kCounts, out); lists > 0; --lists) {
      copy(kFirstCorners, out);
      for (int i = 0; i < 2; ++i) copy(kOtherCorners, out);
      copy(kSides, out);
      const std::uint64_t count = copy(kListSizes, out);
      for (std::uint64_t k = 0; k < count; ++k) {
        sample.rest = byte(kQuarters);
        for (std::size_t i = 0; i < 3; ++i) {
          sample.voxel[i] += unzigzag(in_[kAlong + i].varint());
        }
        const std::uint64_t now = joined(sample);
        out.varint(k == 0 ? zigzag(static_cast<std::int64_t>(now - last)) : now - last);
        last = now;
      }
    }
  }

  std::vector<ByteReader> in_;
  KnownVertices known_;
  std::array<std::int64_t, 3> last_{};
};

bool has_own_frame(std::size_t bytes) {
  return bytes >= kLongColumn;
}

std::array<std::vector<std::byte>, kColumns> unpack_columns(std::span<const std::byte> packed) {
  ByteReader in(packed);
  if (in.low_bytes(kSumBytes) != io::checksum(in.rest())) {
    throw BadBytes{"its checksum is wrong"};
  }
  std::array<std::size_t, kColumns> sizes{}, frames{};
  std::size_t joined_bytes = 0;
  for (std::size_t c = 0; c < kColumns; ++c) {
    sizes[c] = in.varint();
    if (has_own_frame(sizes[c])) {
      frames[c] = in.varint();
    } else {
      joined_bytes += sizes[c];
    }
  }
  std::array<std::vector<std::byte>, kColumns> out;
  for (std::size_t c = 0; c < kColumns; ++c) {
    if (!has_own_frame(sizes[c])) continue;
    out[c] = io::unpack_zstd(in.bytes(frames[c]), sizes[c], "versions");
  }
  const std::vector<std::byte> joined = io::unpack_zstd(in.rest(), joined_bytes, "versions");
  ByteReader all(joined);
  for (std::size_t c = 0; c < kColumns; ++c) {
    if (has_own_frame(sizes[c])) continue;
    const std::span<const std::byte> column = all.bytes(sizes[c]);
    out[c] = {column.begin(), column.end()};
  }
  return out;
}

}  // namespace

std::vector<std::byte> pack_blocks(std::span<const std::vector<std::byte>> blocks,
                                   io::ZstdPacker& packer) {
  ColumnWriter writer;
  for (const std::vector<std::byte>& block : blocks) writer.add(block);
  std::vector<std::byte> frames, joined;
  ByteWriter head;
  head.low_bytes(0, kSumBytes);
  for (ByteWriter& column : writer.columns) {
    const std::span<const std::byte> bytes = column.written();
    head.varint(bytes.size());
    if (has_own_frame(bytes.size())) {
      const std::size_t before = frames.size();
      packer.append(bytes, frames);
      head.varint(frames.size() - before);
    } else {
      joined.insert(joined.end(), bytes.begin(), bytes.end());
    }
  }
  packer.append(joined, frames);
  std::vector<std::byte> out(head.written().begin(), head.written().end());
  out.insert(out.end(), frames.begin(), frames.end());
  io::store_little<std::uint32_t>(io::checksum(std::span(out).subspan(kSumBytes)), out.data());
  return out;
}

std::vector<std::byte> unpack_block(std::span<const std::byte> packed, std::size_t index) {
  const std::array<std::vector<std::byte>, kColumns> columns = unpack_columns(packed);
  ColumnReader reader(columns);
  for (std::size_t i = 0; i < index; ++i) reader.pass();
  return reader.next();
}

}  // namespace mw::engine
