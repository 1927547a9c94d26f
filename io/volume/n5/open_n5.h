// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens an array of an N5 container, looked for where the caller did not name it: what its
// attributes.json describes, and its blocks, a file each.
// Format: https://github.com/saalfeldlab/n5
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/chunks/chunk.h"
#include "io/codec/codec.h"
#include "io/json/json.h"
#include "io/json/json_fields.h"
#include "io/store/place.h"
#include "io/volume/label_volume.h"
#include "io/volume/open_options.h"

namespace mw::io {

struct N5Document {
  Json json;
  std::string file;

  /// Looks at json, which must outlive it.  ERRORS: mw::Error(kInput) when that is no object.
  [[nodiscard]] JsonFields fields() const { return {json, file}; }
};

/// Returns the attributes of a folder; nothing where it has none.
/// ERRORS: mw::Error(kInput) when the file cannot be read or is no JSON.
[[nodiscard]] std::optional<N5Document> read_attributes(const Place& folder);

/// Axes go from the fastest to the slowest, as N5 has them.
struct N5Array {
  VoxelType type = VoxelType::kU8;
  Codec codec = Codec::kNone;
  std::vector<std::int64_t> dimensions;
  std::vector<std::int64_t> block_size;  ///< blocks at the end may be smaller
  /// Which axes are x, y and z; the others have extent 1.  -1 stands for an axis that is not in the
  /// array, which has extent 1, too.
  std::array<int, 3> axes{0, 1, 2};
};

/// Whether the attributes are those of an array, not of a group.
[[nodiscard]] bool is_n5_array(const JsonFields& attributes);

/// Reads the attributes of an array, checks all numbers, and bounds what blocks may take.
/// ERRORS: mw::Error(kInput) naming file and field, also when more than three axes have extents
/// above 1.
[[nodiscard]] N5Array parse_n5_array(const JsonFields& attributes);

/// Return the sizes of the array and of its blocks along x, y and z.
[[nodiscard]] Index3 shape_of(const N5Array& array);
[[nodiscard]] Index3 block_of(const N5Array& array);

/// Reads block files, which have a mode (u16), the number of axes (u16), extents (u32 each) and in
/// mode 1 the number of values (u32); then the values, packed, the most significant byte first.
class N5Blocks : public ChunkSource {
 public:
  /// folder is that of the array.
  N5Blocks(Place folder, N5Array array);

  [[nodiscard]] std::string name() const override { return folder_.string(); }
  [[nodiscard]] std::string name_of(Index3 chunk) const override { return path_of(chunk).string(); }
  [[nodiscard]] std::optional<Chunk> load(Index3 chunk, const Box3& box,
                                          ChunkPlace place) const override;
  [[nodiscard]] std::uint64_t scratch_bytes() const override { return scratch_; }
  [[nodiscard]] std::optional<std::uint64_t> streaming_bytes() const override;

 private:
  [[nodiscard]] Place path_of(Index3 chunk) const;
  [[nodiscard]] std::uint64_t max_file_bytes() const;
  [[nodiscard]] std::uint64_t found_scratch() const;

  Place folder_;
  N5Array array_;
  std::uint64_t scratch_;
};

/// The attributes of an array, and those around a level of a pyramid (s0, s1, ... in a group).
struct N5Attributes {
  const N5Document& own;
  const N5Document* group = nullptr;   ///< null: none, or not a level
  const N5Document* finest = nullptr;  ///< those of s0; null for s0 itself
  std::size_t level = 0;
};

/// Returns the place by `transform` {axes, units, scale, translate} (COSEM: the centre of the first
/// voxel; names of axes give the order), of the array or else of its level in `multiscales` of the
/// group, else by `pixelResolution` or `resolution`, `units` and
/// `offset` (the first corner), fastest axis first.  A level whose resolution is missing, or that
/// of the finest one, has the latter times its `downsamplingFactors`; pyramids share a corner.
/// ERRORS: mw::Error(kInput) naming file and field.  What the options replace is not looked at.
[[nodiscard]] VolumeSpace n5_space(const N5Attributes& attributes, const N5Array& array,
                                   const OpenOptions& options);
/// Returns the number of the first voxel by the same place (number_of_first_voxel()).
[[nodiscard]] Index3 n5_offset(const N5Attributes& attributes, const N5Array& array);

/// Returns the folder of the array: options.dataset in the container, or the only array or pyramid
/// that there is; in a pyramid (a group with s0, s1, ...) the level options.scale.
/// ERRORS: mw::Error(kInput) when there is none or several, with their names; kUsage when the
/// options name one that is not there.
[[nodiscard]] Place find_n5_array(const Place& container, const OpenOptions& options);

/// Returns the number of a level by the name of its folder, "s2"; nothing for other names.
[[nodiscard]] std::optional<std::size_t> level_of(const Place& folder);

/// Whether the folder has an attributes.json, levels of a pyramid, or a name with .n5.
[[nodiscard]] bool is_n5(const Place& folder);

/// Opens an array (find_n5_array) at its place (n5_space).  Blocks are raw or packed by gzip, zlib,
/// bzip2, xz, lz4, blosc or zstd; what is not there has label 0.
/// ERRORS: mw::Error(kInput) naming file and field; kUsage when there is no such dataset or level.
[[nodiscard]] std::unique_ptr<LabelVolume> open_n5(const Place& folder, const OpenOptions& options);

/// Returns how many levels the pyramid has that open_n5() looks at; 1 for an array.
/// ERRORS: those of find_n5_array().
[[nodiscard]] std::size_t count_n5_scales(const Place& container, const OpenOptions& options);

}  // namespace mw::io
