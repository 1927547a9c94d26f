// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a MetaImage file as a volume.
#include "io/volume/metaimage/open_metaimage.h"

#include <algorithm>

#include "io/file/errors.h"
#include "io/file/source/file_source.h"
#include "io/file/source/inflated_source.h"
#include "io/volume/checks.h"
#include "io/volume/raw_array.h"

namespace mw::io {
namespace {

constexpr const char* kDataField = "MetaImage field 'ElementDataFile'";

/// Bytes, and where the voxels (packed or not) begin in them.
struct Placed {
  std::unique_ptr<ByteSource> source;
  std::uint64_t offset = 0;
};

/// The header's file, and whether the files that it names may be anywhere.
struct HeaderFile {
  std::filesystem::path path;
  bool is_trusted;

  [[nodiscard]] std::filesystem::path named(std::string_view name) const {
    return named_beside(path, kDataField, name, is_trusted);
  }
};

Placed one_file(std::unique_ptr<ByteSource> source, const MetaImageHeader& header,
                const HeaderFile& file, std::uint64_t needed) {
  const bool local =
      header.data_file == "LOCAL" || header.data_file == "Local" || header.data_file == "local";
  Placed data{std::move(source), local ? header.bytes : 0};
  if (!local) {
    data.source = std::make_unique<FileSource>(file.named(header.data_file));
  }
  if (header.header_size > 0) data.offset = static_cast<std::uint64_t>(header.header_size);
  if (header.header_size < 0) {
    const std::uint64_t size = data.source->size();
    if (size >= data.offset + needed) data.offset = size - needed;
  }
  return data;
}

std::unique_ptr<ByteSource> many_files(const MetaImageHeader& header, std::string_view behind,
                                       const HeaderFile& file, std::uint64_t needed) {
  const std::string name = file.path.string();
  if (header.compressed) {
    fail_input(name, "MetaImage field 'CompressedData'",
               "compressed slices in files of their own are not supported",
               "save as one file, or uncompressed");
  }
  std::vector<std::filesystem::path> files;
  for (const std::string& slice : slice_names(header.data_file, behind, header.shape.z, name)) {
    files.push_back(file.named(slice));
  }
  const std::uint64_t slice = needed / static_cast<std::uint64_t>(header.shape.z);
  return std::make_unique<JoinedFiles>(std::move(files), header.header_size, slice, name);
}

void inflate(Placed& data, const MetaImageHeader& header, std::uint64_t needed) {
  // Deflate adds a few bytes to what it cannot pack; the file itself may be packed once more.
  const std::uint64_t max = saturating_sum(saturating_product(needed, 2), 1 << 20);
  const std::uint64_t end =
      data.source->size_within(saturating_sum(data.offset, header.packed_bytes.value_or(max)));
  const DeflatedBytes position{.offset = std::min(data.offset, end),
                               .end = end,
                               .framing = DeflateFraming::kZlibOrGzip,
                               .field = "compressed voxel data"};
  data = {inflate_to_scratch(*data.source, position, needed), 0};
}

}  // namespace

std::unique_ptr<LabelVolume> open_metaimage(std::unique_ptr<ByteSource> source,
                                            const OpenOptions& options) {
  std::string head(source->size_within(kMaxMetaImageBytes), '\0');
  source->read_at(0, std::as_writable_bytes(std::span(head)));
  const HeaderFile file{.path = source->name(), .is_trusted = options.trust_paths};
  const MetaImageHeader header = parse_metaimage_header(head, source->name());
  VolumeInfo info{.shape = header.shape, .type = header.type, .format = "metaimage"};
  info.space = placed(source->name(), header.space, options);
  const std::uint64_t needed = payload_bytes(info);
  Placed data;
  if (names_many_files(header.data_file)) {
    data.source = many_files(header, std::string_view(head).substr(header.bytes), file, needed);
  } else {
    data = one_file(std::move(source), header, file, needed);
    if (header.compressed) inflate(data, header, needed);
  }
  check_payload(*data.source, info, data.offset);
  return std::make_unique<RawArrayVolume>(
      std::move(data.source), std::move(info),
      ArrayLayout{.offset = data.offset, .order = header.order});
}

}  // namespace mw::io
