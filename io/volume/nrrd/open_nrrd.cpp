// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens an NRRD file as a volume.
#include "io/volume/nrrd/open_nrrd.h"

#include <algorithm>

#include "io/file/source/file_source.h"
#include "io/file/source/inflated_source.h"
#include "io/volume/checks.h"
#include "io/volume/file_space.h"
#include "io/volume/raw_array.h"

namespace mw::io {
namespace {

NrrdHeader read_header(const ByteSource& source) {
  std::string head(source.size_within(kMaxNrrdHeaderBytes), '\0');
  source.read_at(0, std::as_writable_bytes(std::span(head)));
  return parse_nrrd_header(head, source.name());
}

/// The source that holds the voxels, still packed when the encoding is gzip.
std::unique_ptr<ByteSource> data_source(std::unique_ptr<ByteSource> source,
                                        const NrrdHeader& header, bool is_trusted) {
  if (header.data_file.empty()) return source;
  return std::make_unique<FileSource>(
      named_beside(source->name(), "NRRD field 'data file'", header.data_file, is_trusted));
}

}  // namespace

std::unique_ptr<LabelVolume> open_nrrd(std::unique_ptr<ByteSource> source,
                                       const OpenOptions& options) {
  const std::string file = source->name();
  const NrrdHeader header = read_header(*source);
  VolumeInfo info{.shape = header.shape, .type = header.type, .format = "nrrd"};
  info.space = placed(file, header.space, options);
  info.names = header.names;

  std::unique_ptr<ByteSource> data = data_source(std::move(source), header, options.trust_paths);
  std::uint64_t offset = header.data_file.empty() ? header.bytes : 0;
  if (header.gzip) {
    data = std::make_unique<InflatedSource>(std::move(data), offset);
    offset = 0;
  }
  const std::uint64_t needed = payload_bytes(info);
  if (header.byte_skip > 0) offset += static_cast<std::uint64_t>(header.byte_skip);
  if (header.byte_skip == -1) {
    const std::uint64_t size = data->size();
    if (size >= offset + needed) offset = size - needed;
  }
  check_payload(*data, info, offset);
  return std::make_unique<RawArrayVolume>(std::move(data), std::move(info),
                                          ArrayLayout{.offset = offset, .order = header.order});
}

}  // namespace mw::io
