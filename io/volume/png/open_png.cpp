// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens PNG slices as a volume.
#include "io/volume/png/open_png.h"

#include "io/chunks/chunked_volume.h"
#include "io/file/errors.h"
#include "io/file/file_source.h"
#include "io/volume/file_space.h"
#include "io/volume/png/png_file.h"

namespace mw::io {
namespace {

/// A slice is a chunk.
class PngChunks : public ChunkSource {
 public:
  PngChunks(std::vector<std::filesystem::path> files, const PngHeader& header)
      : files_(std::move(files)), header_(header) {}

  [[nodiscard]] std::string name() const override { return files_.front().parent_path().string(); }
  [[nodiscard]] std::string name_of(Index3 chunk) const override {
    return files_[static_cast<std::size_t>(chunk.z)].string();
  }
  [[nodiscard]] std::optional<Chunk> load(Index3 chunk, const Box3& /*box*/) const override {
    const FileSource file(files_[static_cast<std::size_t>(chunk.z)]);
    if (read_png_header(file) != header_) {
      fail_input(file.name(), "PNG header", "changed while it was read");
    }
    return Chunk{.bytes = read_png(file, header_), .strides = {1, header_.width, 0}};
  }
  /// The rows' places, and libpng's window and row.
  [[nodiscard]] std::uint64_t scratch_bytes() const override {
    constexpr std::uint64_t kLibrary = 1 << 20;
    return kLibrary + 8 * static_cast<std::uint64_t>(header_.height) + 4 * header_.row_bytes();
  }

 private:
  std::vector<std::filesystem::path> files_;
  PngHeader header_;
};

void check_alike(const std::vector<std::filesystem::path>& files, const PngHeader& first) {
  for (const std::filesystem::path& path : files) {
    const PngHeader header = read_png_header(FileSource(path));
    if (header == first) continue;
    fail_input(
        path.string(), "PNG header",
        text(header.width, " x ", header.height, " pixels of ", name(header.type),
             ", the first slice is ", first.width, " x ", first.height, " of ", name(first.type)),
        "save all slices of one size and type");
  }
}

}  // namespace

std::unique_ptr<LabelVolume> open_png(std::unique_ptr<ByteSource> source,
                                      const OpenOptions& options) {
  return open_png_slices({source->name()}, options);
}

std::unique_ptr<LabelVolume> open_png_slices(std::vector<std::filesystem::path> files,
                                             const OpenOptions& options) {
  const PngHeader header = read_png_header(FileSource(files.front()));
  check_alike(files, header);
  VolumeInfo info{.shape = {header.width, header.height, static_cast<std::int64_t>(files.size())},
                  .type = header.type,
                  .format = "png",
                  .chunk = {header.width, header.height, 1}};
  info.space = placed(files.front().string(), {}, options);
  const VoxelCoding coding{info.type, ByteOrder::kBig, {}};
  return std::make_unique<ChunkedVolume>(std::move(info), coding, 0,
                                         std::make_unique<PngChunks>(std::move(files), header),
                                         options.cache_bytes);
}

}  // namespace mw::io
