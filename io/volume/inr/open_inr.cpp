// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens an INRIMAGE-4 file as a volume.
#include "io/volume/inr/open_inr.h"

#include <algorithm>

#include "io/volume/checks.h"
#include "io/volume/inr/inr_header.h"
#include "io/volume/raw_array.h"

namespace mw::io {

bool has_inr_magic(std::span<const std::byte> head) {
  return std::string_view(reinterpret_cast<const char*>(head.data()), head.size())
      .starts_with("#INRIMAGE-4#{");
}

std::unique_ptr<LabelVolume> open_inr(std::unique_ptr<ByteSource> source,
                                      const OpenOptions& options) {
  std::string head(source->size_within(kMaxInrHeaderBytes), '\0');
  source->read_at(0, std::as_writable_bytes(std::span(head)));
  const InrHeader header = parse_inr_header(head, source->name());
  VolumeInfo info{.shape = header.shape, .type = header.type, .format = "inr"};
  info.space = placed(source->name(), header.space, options);
  check_payload(*source, info, header.bytes);
  return std::make_unique<RawArrayVolume>(
      std::move(source), std::move(info),
      ArrayLayout{.offset = header.bytes, .order = header.order});
}

}  // namespace mw::io
