// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Codecs of chunks: any bytes unpack to few enough bytes or are refused; packed ones come back.
#include <algorithm>
#include <array>

#include "io/codec/codec.h"
#include "io/volume/precomputed/open_precomputed.h"
#include "tests/fuzz/all_targets.h"
#include "tests/fuzz/choices.h"
#include "tests/io/codec/packers.h"
#include "tests/io/volume/precomputed/precomputed_sample.h"

namespace mw::fuzz {
namespace {

using Unpack = std::vector<std::byte> (*)(Bytes packed, std::size_t max, std::string_view name);
using Pack = std::string (*)(const std::string& plain);

struct Packing {
  Unpack unpack;
  Pack pack;
};

template <io::Codec codec>
std::vector<std::byte> unpack_as(Bytes packed, std::size_t max, std::string_view name) {
  return io::unpack(codec, packed, max, name);
}

/// Nothing but literal runs.
std::string lzf_packed(const std::string& plain) {
  std::string out;
  for (std::size_t at = 0; at < plain.size(); at += 32) {
    const std::string run = plain.substr(at, 32);
    out += static_cast<char>(run.size() - 1) + run;
  }
  return out;
}

/// Blocks of 100 bytes, stored where they do not shrink.
std::string lz4_hdf5_packed(const std::string& plain) {
  std::string out = io::number_bytes(plain.size(), 8, true) + io::number_bytes(100, 4, true);
  for (std::size_t at = 0; at < plain.size(); at += 100) {
    const std::string part = plain.substr(at, 100);
    const std::string packed = io::lz4_block(part);
    const std::string& body = packed.size() < part.size() ? packed : part;
    out += io::number_bytes(body.size(), 4, true) + body;
  }
  return out;
}

constexpr std::array kPackings{
    Packing{unpack_as<io::Codec::kGzip>, [](const std::string& p) { return io::gzip(p); }},
    Packing{unpack_as<io::Codec::kZlib>, [](const std::string& p) { return io::zlib_packed(p); }},
    Packing{unpack_as<io::Codec::kZstd>, [](const std::string& p) { return io::zstd_packed(p); }},
    Packing{unpack_as<io::Codec::kBlosc>,
            [](const std::string& p) { return io::blosc_packed(p, "lz4", 1, 4); }},
    Packing{unpack_as<io::Codec::kLz4>, [](const std::string& p) { return io::lz4_packed(p); }},
    Packing{unpack_as<io::Codec::kLz4Java>,
            [](const std::string& p) { return io::java_packed(p); }},
    Packing{unpack_as<io::Codec::kBzip2>, [](const std::string& p) { return io::bzip2_packed(p); }},
    Packing{unpack_as<io::Codec::kXz>, [](const std::string& p) { return io::xz_packed(p, 0); }},
    Packing{unpack_as<io::Codec::kLzf>, lzf_packed},
    Packing{unpack_as<io::Codec::kLz4Hdf5>, lz4_hdf5_packed},
};

Bytes bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}

bool same(Bytes a, Bytes b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace

/// The first byte says which codec, and whether the others are packed or plain.
void fuzz_codecs(Bytes bytes) {
  constexpr std::size_t kMax = 1 << 14;
  Choices choices(bytes);
  const std::uint32_t choice = choices.below(2 * kPackings.size());
  const Packing& packing = kPackings[choice / 2];
  if (choice % 2 == 0) {
    ends_well([&] {
      require(packing.unpack(choices.rest(), kMax, "fuzzed chunk").size() <= kMax, "no more");
    });
    return;
  }
  const std::string plain(text_of(choices.rest()));
  const std::string packed = packing.pack(plain);
  require(same(packing.unpack(bytes_of(packed), plain.size(), "chunk"), bytes_of(plain)),
          "what is packed comes back");
}

/// The first bytes are the layout; the others are a chunk, and then labels of one.
void fuzz_segmentation(Bytes bytes) {
  Choices choices(bytes);
  const auto edge = [&] { return 1 + std::int64_t{choices.below(9)}; };
  const auto corner = [&] {
    const std::int64_t x = edge(), y = edge();
    return Index3{x, y, edge()};
  };
  const Index3 shape = corner(), block = corner();
  const auto type = choices.below(2) == 0 ? io::VoxelType::kU32 : io::VoxelType::kU64;
  const io::SegmentationLayout layout{.shape = shape, .block = block, .type = type};
  const Bytes packed = choices.rest();
  ends_well([&] {
    const auto size = static_cast<std::size_t>(shape.product() * io::byte_size(type));
    require(io::unpack_segmentation(packed, layout, "fuzzed chunk").size() == size, "all voxels");
  });
  std::vector<RawLabel> labels(static_cast<std::size_t>(shape.product()));
  for (RawLabel& label : labels) label = choices.byte();
  io::Random random(1);
  const std::string own =
      io::encode_segmentation(random, labels, shape, block, io::byte_size(type));
  require(same(io::unpack_segmentation(bytes_of(own), layout, "chunk"),
               bytes_of(io::voxel_bytes(labels, type, false))),
          "what is encoded comes back");
}

}  // namespace mw::fuzz
