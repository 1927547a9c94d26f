// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What every volume must do: give back each region, and refuse what is wrong or damaged with an
// error that names the file.
#pragma once

#include "io/file/errors.h"
#include "io/volume/open_volume.h"
#include "tests/io/test_files.h"

namespace mw::io {

using Random = std::mt19937;

/// A whole number from lo to hi.
inline std::int64_t pick(Random& random, std::int64_t lo, std::int64_t hi) {
  return lo + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(hi - lo + 1));
}

inline Index3 pick_shape(Random& random, std::int64_t max) {
  return {pick(random, 1, max), pick(random, 1, max), pick(random, 1, max)};
}

/// Makes the folders above the file, too.  A file that is there is removed first: what is cut and
/// written again goes to the disk at once on some file systems.
inline void write_file(const std::filesystem::path& path, const std::string& content) {
  std::filesystem::create_directories(path.parent_path());
  std::filesystem::remove(path);
  std::ofstream(path, std::ios::binary) << content;
}

/// Blocks of few labels out of all bits of the type, and single voxels between them.
inline std::vector<RawLabel> random_labels(Random& random, Index3 shape, VoxelType type) {
  const std::vector<RawLabel> colours = sample_labels({40, 1, 1}, type);
  std::vector<RawLabel> labels;
  const std::int64_t cell = pick(random, 1, 5);
  const std::uint64_t seed = random();
  for (std::int64_t z = 0; z < shape.z; ++z) {
    for (std::int64_t y = 0; y < shape.y; ++y) {
      for (std::int64_t x = 0; x < shape.x; ++x) {
        const auto position =
            static_cast<std::uint64_t>((z / cell * 31 + y / cell) * 31 + x / cell);
        const std::uint64_t mixed = (position + seed) * 6364136223846793005U;
        labels.push_back(random() % 20 == 0 ? colours[random() % 40] : colours[(mixed >> 40) % 40]);
      }
    }
  }
  return labels;
}

/// The part of an x-fastest array.
inline std::vector<RawLabel> part_of(const std::vector<RawLabel>& labels, Index3 shape,
                                     const Box3& box) {
  const Box3 all{{0, 0, 0}, shape};
  std::vector<RawLabel> out;
  for (Index3 v = box.lo; v.z < box.hi.z; ++v.z) {
    for (v.y = box.lo.y; v.y < box.hi.y; ++v.y) {
      for (v.x = box.lo.x; v.x < box.hi.x; ++v.x) {
        out.push_back(labels[static_cast<std::size_t>(all.offset(v))]);
      }
    }
  }
  return out;
}

/// Calls visit(chunk number, box of its voxels) for each chunk of the grid.
inline void each_chunk(Index3 shape, Index3 chunk,
                       const std::function<void(Index3, const Box3&)>& visit) {
  for (std::int64_t z = 0; z * chunk.z < shape.z; ++z) {
    for (std::int64_t y = 0; y * chunk.y < shape.y; ++y) {
      for (std::int64_t x = 0; x * chunk.x < shape.x; ++x) {
        const Index3 lo{x * chunk.x, y * chunk.y, z * chunk.z};
        visit({x, y, z}, intersection({lo, lo + chunk}, {{0, 0, 0}, shape}));
      }
    }
  }
}

/// The whole and random boxes are what the array has there.
inline void expect_regions(Random& random, const LabelVolume& volume, Index3 shape,
                           const std::vector<RawLabel>& labels, int boxes = 8) {
  ASSERT_EQ(volume.info().shape, shape);
  ASSERT_EQ(read_all(volume), labels);
  for (int round = 0; round < boxes; ++round) {
    const Index3 lo{pick(random, 0, shape.x - 1), pick(random, 0, shape.y - 1),
                    pick(random, 0, shape.z - 1)};
    const Index3 hi{pick(random, lo.x + 1, shape.x), pick(random, lo.y + 1, shape.y),
                    pick(random, lo.z + 1, shape.z)};
    const Box3 box{lo, hi};
    std::vector<RawLabel> got(static_cast<std::size_t>(box.voxels()));
    volume.read(box, got);
    ASSERT_EQ(got, part_of(labels, shape, box));
  }
}

/// Expects these labels, in whole and in random boxes, in the shape that the volume says.
inline void expect_boxes(const LabelVolume& volume, const std::vector<RawLabel>& labels,
                         unsigned seed = 1, int boxes = 50) {
  Random random(seed);
  expect_regions(random, volume, volume.info().shape, labels, boxes);
}

/// Reads a volume that may claim any size: all of it when that is little, else its last voxels.
inline void read_some(const LabelVolume& volume) {
  const Index3 shape = volume.info().shape;
  constexpr std::int64_t kMaxVoxels = 1 << 20;
  Box3 box{{0, 0, 0}, shape};
  if (shape.product() > kMaxVoxels) box.lo = shape - Index3{1, 1, 1};
  std::vector<RawLabel> labels(static_cast<std::size_t>(box.voxels()));
  volume.read(box, labels);
}

/// Opening it is an error about the input that names the path, or a file in that folder, and has
/// every piece.
inline void expect_not_opened(const std::filesystem::path& path, std::vector<std::string> pieces,
                              const OpenOptions& options = {}, ErrorKind kind = ErrorKind::kInput) {
  pieces.push_back(path.string());
  expect_error(kind, pieces, [&] { static_cast<void>(open_volume(path, options)); });
}
/// Expects that options that do not fit the volume are a usage error with every piece.
inline void expect_misused(const std::filesystem::path& path, const OpenOptions& options,
                           const std::vector<std::string>& pieces) {
  expect_not_opened(path, pieces, options, ErrorKind::kUsage);
}
/// Expects that opening or reading the volume is an error about the input with every piece.
inline void expect_not_read(const std::filesystem::path& path, std::vector<std::string> pieces) {
  pieces.push_back(path.string());
  expect_error(ErrorKind::kInput, pieces, [&] { read_some(*open_volume(path)); });
}

/// Opens and reads it; whether it was refused.  Anything but success and an error about the input
/// that names its folder fails the test.
inline bool is_refused(const std::filesystem::path& path, const OpenOptions& options = {},
                       const std::string& what = "") {
  try {
    read_some(*open_volume(path, options));
    return false;
  } catch (const Error& error) {
    EXPECT_TRUE(error.kind() == ErrorKind::kInput || error.kind() == ErrorKind::kUsage)
        << what << ": " << error.what();
    EXPECT_NE(std::string(error.what()).find(path.parent_path().string()), std::string::npos)
        << what << ": names no file: " << error.what();
  } catch (const std::exception& other) {
    ADD_FAILURE() << what << ": " << other.what();
  }
  return true;
}

/// Damages the file in every way that is tried here: cut at every length, every bit flipped (in
/// large files every `step`-th place); each time the store is read or refused.
/// ENSURES: the file is as before; returns how often the store was refused.
inline int refused_when_damaged(const std::filesystem::path& store,
                                const std::filesystem::path& file, std::size_t step,
                                const OpenOptions& options = {}) {
  const std::string whole = content_of(file);
  int refused = 0;
  for (std::size_t at = 0; at < whole.size(); at += step) {
    write_file(file, whole.substr(0, at));
    refused += is_refused(store, options) ? 1 : 0;
    for (int bit = 0; bit < 8; ++bit) {
      std::string flipped = whole;
      flipped[at] = static_cast<char>(flipped[at] ^ (1 << bit));
      write_file(file, flipped);
      refused += is_refused(store, options) ? 1 : 0;
    }
  }
  write_file(file, whole);
  EXPECT_FALSE(is_refused(store, options));
  return refused;
}

/// Cuts the file at `cuts` lengths (all when it is shorter) and changes each of its first `flips`
/// bytes in four ways; each time it is read or refused.
inline void damage_everywhere(const TempDir& dir, const std::string& name,
                              const std::string& content, std::size_t flips = 4096,
                              std::size_t cuts = 1000) {
  const auto path = dir.path() / name;
  const std::size_t step = content.size() / cuts + 1;
  for (std::size_t length = 0; length < content.size(); length += step) {
    write_file(path, content.substr(0, length));
    is_refused(path, {}, text("cut at ", length));
  }
  for (std::size_t at = 0; at < std::min(flips, content.size()); ++at) {
    for (const int bits : {0x01, 0x10, 0x80, 0xff}) {
      std::string bad = content;
      bad[at] = static_cast<char>(bad[at] ^ bits);
      write_file(path, bad);
      is_refused(path, {}, text("byte ", at, " xor ", bits));
    }
  }
}

}  // namespace mw::io
