// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a .npy file as a volume.
#include "io/volume/npy/open_npy.h"

#include "io/file/errors.h"
#include "io/volume/checks.h"
#include "io/volume/file_space.h"
#include "io/volume/npy/npy_header.h"
#include "io/volume/raw_array.h"

namespace mw::io {

std::unique_ptr<LabelVolume> open_npy(std::unique_ptr<ByteSource> source,
                                      const OpenOptions& options) {
  const NpyPrefix prefix = parse_npy_prefix(read_prefix(*source, 12), source->name());
  const std::size_t offset = prefix.dict_offset + prefix.dict_length;
  const std::uint64_t held = source->size_within(offset);
  if (held < offset) {
    fail_input(source->name(), "npy header",
               text("truncated: it needs ", offset, " bytes, the file holds ", held),
               "get a whole copy of the file");
  }
  std::string dict(prefix.dict_length, '\0');
  source->read_at(prefix.dict_offset, std::as_writable_bytes(std::span(dict)));
  const NpyHeader header = parse_npy_dict(dict, source->name());
  VolumeInfo info{.shape = header.shape, .type = header.type, .format = "npy"};
  info.z_fastest = header.fortran_order;
  info.space = placed(source->name(), {}, options);
  check_payload(*source, info, offset);
  return std::make_unique<RawArrayVolume>(std::move(source), std::move(info),
                                          ArrayLayout{.offset = offset, .order = header.order});
}

}  // namespace mw::io
