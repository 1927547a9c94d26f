// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Files that are cut, flipped and lied in: each is read, or refused with an error.
#pragma once

#include <random>

#include "io/file/errors.h"
#include "io/volume/open_volume.h"
#include "tests/io/test_files.h"

namespace mw::io {

/// Reads a volume that may claim any size: all of it when that is little, else its last voxels.
inline void read_some(const LabelVolume& volume) {
  const Index3 shape = volume.info().shape;
  constexpr std::int64_t kMaxVoxels = 1 << 20;
  Box3 box{{0, 0, 0}, shape};
  if (shape.product() > kMaxVoxels) box.lo = shape - Index3{1, 1, 1};
  std::vector<RawLabel> labels(static_cast<std::size_t>(box.voxels()));
  volume.read(box, labels);
}

/// Opens and reads path; anything but success and an error about the input fails the test.
inline bool is_read_or_refused(const std::filesystem::path& path, const OpenOptions& options,
                               const std::string& what) {
  try {
    read_some(*open_volume(path, options));
    return true;
  } catch (const Error& error) {
    EXPECT_TRUE(error.kind() == ErrorKind::kInput || error.kind() == ErrorKind::kUsage)
        << what << ": " << error.what();
    EXPECT_NE(std::string(error.what()).find(path.parent_path().string()), std::string::npos)
        << what << ": names no file: " << error.what();
  } catch (const std::exception& other) {
    ADD_FAILURE() << what << ": " << other.what();
  }
  return false;
}

/// A file system that flushes what replaces a file's content would make thousands of them slow.
inline std::filesystem::path fresh_file(const TempDir& dir, const std::string& name,
                                        const std::string& content) {
  std::filesystem::remove(dir.path() / name);
  return dir.file(name, content);
}

/// Cuts the file at `cuts` lengths (all when it is shorter) and changes each of its first `flips`
/// bytes in four ways.  Returns how many of the damaged files were read all the same.
inline int damage_everywhere(const TempDir& dir, const std::string& name,
                             const std::string& content, std::size_t flips = 4096,
                             std::size_t cuts = 1000, const OpenOptions& options = {}) {
  int read = 0;
  const std::size_t step = content.size() / cuts + 1;
  for (std::size_t length = 0; length < content.size(); length += step) {
    const auto path = fresh_file(dir, name, content.substr(0, length));
    read += is_read_or_refused(path, options, text("cut at ", length));
  }
  for (std::size_t at = 0; at < std::min(flips, content.size()); ++at) {
    for (const int bits : {0x01, 0x10, 0x80, 0xff}) {
      std::string bad = content;
      bad[at] = static_cast<char>(bad[at] ^ bits);
      read +=
          is_read_or_refused(fresh_file(dir, name, bad), options, text("byte ", at, " xor ", bits));
    }
  }
  return read;
}

/// Random boxes of the volume are those of the whole array.
inline void expect_boxes(const LabelVolume& volume, const std::vector<RawLabel>& all,
                         unsigned seed = 1, int boxes = 50) {
  const Index3 n = volume.info().shape;
  ASSERT_EQ(static_cast<std::size_t>(n.product()), all.size());
  std::mt19937 random(seed);
  const auto below = [&](std::int64_t end) {
    return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(end));
  };
  for (int i = 0; i < boxes; ++i) {
    const Index3 lo{below(n.x), below(n.y), below(n.z)};
    const Index3 hi{lo.x + 1 + below(n.x - lo.x), lo.y + 1 + below(n.y - lo.y),
                    lo.z + 1 + below(n.z - lo.z)};
    const Box3 box{lo, hi};
    std::vector<RawLabel> got(static_cast<std::size_t>(box.voxels()), 77);
    volume.read(box, got);
    std::size_t next = 0;
    for (std::int64_t z = lo.z; z < hi.z; ++z) {
      for (std::int64_t y = lo.y; y < hi.y; ++y) {
        for (std::int64_t x = lo.x; x < hi.x; ++x) {
          ASSERT_EQ(got[next++], all[static_cast<std::size_t>((z * n.y + y) * n.x + x)])
              << "voxel " << x << " " << y << " " << z;
        }
      }
    }
  }
}

}  // namespace mw::io
